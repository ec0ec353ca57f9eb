// The built program while it runs: typed to, read from, stopped by signals.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/linux/descriptor.hpp"

namespace fencepost::host::testing {

/// Until `done` or, generously, too late; whether it was done.
inline bool until_done(const std::function<bool()>& done) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!done()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    ::usleep(1000);
  }
  return true;
}

class RunningProgram {
 public:
  /// `fencepost arguments...` in that folder.
  RunningProgram(const std::string& folder, const std::vector<std::string>& arguments) {
    std::array<linux::Descriptor, 2> in = pipe();
    std::array<linux::Descriptor, 2> out = pipe();
    std::array<linux::Descriptor, 2> err = pipe();
    std::vector<std::string> words = {FENCEPOST_EXE};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ == 0) {
      ::dup2(in[0].get(), STDIN_FILENO);
      ::dup2(out[1].get(), STDOUT_FILENO);
      ::dup2(err[1].get(), STDERR_FILENO);
      if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
      ::_exit(127);
    }
    in_ = std::move(in[1]);
    out_ = std::move(out[0]);
    err_ = std::move(err[0]);
    for (const int fd : {out_.get(), err_.get()}) ::fcntl(fd, F_SETFL, O_NONBLOCK);
  }
  ~RunningProgram() {
    if (pid_ > 0) end(SIGKILL);
  }
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void type(std::string_view text) {
    ASSERT_EQ(::write(in_.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void close_input() { in_.close(); }
  /// All that came so far.
  const std::string& out() { return more(out_, out_text_); }
  const std::string& err() { return more(err_, err_text_); }
  bool shows(std::string_view text) {
    return until_done([&] { return out().find(text) != std::string::npos; });
  }
  bool says(std::string_view text) {
    return until_done([&] { return err().find(text) != std::string::npos; });
  }
  /// Sends the signal, if one is given, and waits; the exit code, or minus the signal that killed it. What came can
  /// still be read.
  int end(int signal = 0) {
    if (signal != 0) ::kill(pid_, signal);
    int status = 0;
    const bool ended = until_done([&] {
      out();
      err();
      return ::waitpid(pid_, &status, WNOHANG) == pid_;
    });
    EXPECT_TRUE(ended);
    if (!ended) ::kill(pid_, SIGKILL), ::waitpid(pid_, &status, 0);
    pid_ = -1;
    out();
    err();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  static std::array<linux::Descriptor, 2> pipe() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    return {linux::Descriptor(ends[0]), linux::Descriptor(ends[1])};
  }
  static const std::string& more(const linux::Descriptor& pipe, std::string& text) {
    std::array<char, 65536> buffer;
    for (ssize_t count = 0; (count = ::read(pipe.get(), buffer.data(), buffer.size())) > 0;) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    }
    return text;
  }

  pid_t pid_ = -1;
  linux::Descriptor in_;
  linux::Descriptor out_;
  linux::Descriptor err_;
  std::string out_text_;
  std::string err_text_;
};

}  // namespace fencepost::host::testing
