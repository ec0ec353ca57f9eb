// The built program in a terminal of its own, as a person has it before them.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "hal/linux/descriptor.hpp"
#include "tests/host/cli/process.hpp"

namespace fencepost::host::testing {

/// 80 columns, 24 rows, and the program's only one: Ctrl-C is a signal, standard output is a terminal.
class Terminal {
 public:
  Terminal(const Folder& folder, const std::vector<std::string>& arguments)
      : master_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    EXPECT_EQ(::grantpt(master_.get()), 0);
    EXPECT_EQ(::unlockpt(master_.get()), 0);
    const winsize size{24, 80, 0, 0};
    ::ioctl(master_.get(), TIOCSWINSZ, &size);
    const std::string path = ::ptsname(master_.get());
    pid_ = ::fork();
    if (pid_ == 0) execute(folder.path().string(), path, arguments);
    ::fcntl(master_.get(), F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    if (status_ || pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    static_cast<void>(wait());
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  void type(const std::string& keys) {
    EXPECT_EQ(::write(master_.get(), keys.data(), keys.size()), static_cast<ssize_t>(keys.size()));
  }
  /// All that it shows so far, with line ends as '\n'.
  const std::string& text() {
    std::array<char, 4096> buffer;
    for (ssize_t count = 0; (count = ::read(master_.get(), buffer.data(), buffer.size())) > 0;) {
      for (ssize_t i = 0; i < count; ++i) {
        if (buffer[static_cast<std::size_t>(i)] != '\r') text_ += buffer[static_cast<std::size_t>(i)];
      }
    }
    return text_;
  }
  [[nodiscard]] bool shows(const std::string& what) {
    return eventually([&] { return text().find(what) != std::string::npos; });
  }
  /// Its exit code; of one that a signal killed, 1000 and its number.
  int wait() {
    const bool over = eventually([&] {
      int status = 0;
      text();
      if (!status_ && ::waitpid(pid_, &status, WNOHANG) == pid_) status_ = status;
      return status_.has_value();
    });
    EXPECT_TRUE(over) << "it does not end: " << text_;
    text();
    if (!over) return -1;
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : 1000 + WTERMSIG(*status_);
  }
  /// The terminal shows what is typed.
  [[nodiscard]] bool echoes() const {
    termios mode{};
    return ::tcgetattr(master_.get(), &mode) == 0 && (mode.c_lflag & ECHO) != 0;
  }

 private:
  [[noreturn]] static void execute(const std::string& folder, const std::string& path,
                                   const std::vector<std::string>& arguments) {
    std::string name = "fencepost";
    std::vector<std::string> copies = arguments;
    std::vector<char*> argv = {name.data()};
    for (std::string& one : copies) argv.push_back(one.data());
    argv.push_back(nullptr);
    ::setsid();
    // The first terminal that the leader of a session opens is its own.
    const int terminal = ::open(path.c_str(), O_RDWR);
    for (const int fd : {0, 1, 2}) ::dup2(terminal, fd);
    ::setenv("TERM", "xterm", 1);
    if (terminal >= 0 && ::chdir(folder.c_str()) == 0) ::execv(FENCEPOST_EXE, argv.data());
    ::_exit(127);
  }

  linux::Descriptor master_;
  pid_t pid_ = -1;
  std::optional<int> status_;
  std::string text_;
};

}  // namespace fencepost::host::testing
