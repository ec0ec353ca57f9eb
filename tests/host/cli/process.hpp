// The built program as a process that runs beside the test: watched, typed at, and asked to stop.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/host/cli/run.hpp"
#include "tests/process/child.hpp"

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
    std::array<int, 2> pipe = {-1, -1};
    EXPECT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    const int out = open_for("out");
    const int err = open_for("err");
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), "fencepost");
    child_.emplace(FENCEPOST_EXE, std::move(words), test::Surroundings{folder_.path(), pipe[0], out, err});
    for (const int fd : {pipe[0], out, err}) ::close(fd);
    typing_ = pipe[1];
  }
  ~Process() { hang_up(); }
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
  void signal(int number) const { EXPECT_TRUE(child_->signal(number)); }

  /// Sends the signal and waits.
  int end(int number) {
    signal(number);
    return wait();
  }
  /// Its exit code; of one that a signal killed, 1000 and its number.
  int wait() {
    if (!eventually([this] { return ended(); })) {
      ADD_FAILURE() << "it does not end";
      child_->signal(SIGKILL);
      child_->wait();
    }
    return child_->exit_code();
  }
  bool ended() { return child_->ended(); }

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
  [[nodiscard]] pid_t pid() const { return child_->pid(); }

 private:
  [[nodiscard]] int open_for(const char* file) const {
    const int opened =
        ::open((folder_.path() / (name_ + file)).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    EXPECT_GE(opened, 0) << file;
    return opened;
  }

  const Folder& folder_;
  std::string name_;
  std::optional<test::Child> child_;
  int typing_ = -1;
};

}  // namespace fencepost::host::testing
