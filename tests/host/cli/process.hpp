// The built program as a process that runs beside the test: watched, typed at, and asked to stop.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/host/cli/run.hpp"

namespace fencepost::host::testing {

/// Generous: it is only reached by a failing test.
inline constexpr std::chrono::seconds kDeadline{60};

/// Waits until `condition` holds; false at the deadline.
inline bool eventually(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

class Process {
 public:
  /// `fencepost arguments...` in `folder`, its output in the files `out` and `err` there, behind `name` where several
  /// run in one folder. Standard input is a pipe, see `type`.
  Process(const Folder& folder, const std::vector<std::string>& arguments, std::string name = {})
      : folder_(folder), name_(std::move(name)) {
    // Before the fork: what an earlier one said here must not be taken for its words.
    for (const char* file : {"out", "err"}) spill(folder_.path() / (name_ + file), "");
    int pipe[2] = {-1, -1};
    EXPECT_EQ(::pipe2(pipe, O_CLOEXEC), 0);
    pid_ = ::fork();
    if (pid_ == 0) execute(pipe[0], arguments);
    ::close(pipe[0]);
    typing_ = pipe[1];
  }
  ~Process() {
    hang_up();
    if (!status_ && pid_ > 0) {
      ::kill(pid_, SIGKILL);
      static_cast<void>(wait());
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void type(const std::string& text) const {
    EXPECT_EQ(::write(typing_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  /// The end of its standard input.
  void hang_up() {
    if (typing_ >= 0) ::close(typing_);
    typing_ = -1;
  }
  void signal(int number) const { EXPECT_EQ(::kill(pid_, number), 0); }

  /// Sends the signal and waits.
  int end(int number) {
    signal(number);
    return wait();
  }
  /// Its exit code; of one that a signal killed, 1000 and its number.
  int wait() {
    const auto end = std::chrono::steady_clock::now() + kDeadline;
    while (!ended()) {
      if (std::chrono::steady_clock::now() > end) {
        ADD_FAILURE() << "it does not end";
        ::kill(pid_, SIGKILL);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 1000 + WTERMSIG(*status_);
  }
  bool ended() {
    int status = 0;
    if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
    return status_.has_value();
  }

  [[nodiscard]] std::string out() const { return slurp(folder_.path() / (name_ + "out")); }
  [[nodiscard]] std::string err() const { return slurp(folder_.path() / (name_ + "err")); }
  /// Waits until standard error, or output, says so.
  [[nodiscard]] bool says(const std::string& text) const {
    return eventually([&] { return err().find(text) != std::string::npos || out().find(text) != std::string::npos; });
  }
  /// Waits until standard output shows it.
  [[nodiscard]] bool shows(const std::string& text) const {
    return eventually([&] { return out().find(text) != std::string::npos; });
  }
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  [[noreturn]] void execute(int input, const std::vector<std::string>& arguments) const {
    std::vector<char*> argv;
    std::string name = "fencepost";
    std::vector<std::string> copies = arguments;
    argv.push_back(name.data());
    for (std::string& one : copies) argv.push_back(one.data());
    argv.push_back(nullptr);
    const bool ready = ::chdir(folder_.path().c_str()) == 0 && ::dup2(input, 0) == 0 && redirect(name_ + "out", 1) &&
                       redirect(name_ + "err", 2);
    if (ready) ::execv(FENCEPOST_EXE, argv.data());
    ::_exit(127);
  }
  static bool redirect(const std::string& file, int fd) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    return opened >= 0 && ::dup2(opened, fd) == fd;
  }

  const Folder& folder_;
  std::string name_;
  pid_t pid_ = -1;
  int typing_ = -1;
  std::optional<int> status_;
};

}  // namespace fencepost::host::testing
