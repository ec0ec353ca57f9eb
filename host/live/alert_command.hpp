// A command of the user, run at each change of the alert level in force.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "host/live/alert_now.hpp"

namespace fencepost::host {

/// Runs the command on a thread of its own, one at a time. Meanwhile the newest change waits, in place of one that
/// waited before. A command that runs longer than `longest` is killed, so that a stop does not wait behind it for ever.
/// If it cannot be killed it is given up, and the next one runs beside it.
class AlertCommand final : public AlertOutput {
 public:
  static constexpr std::chrono::milliseconds kLongest{2'000};

  using Kill = int (*)(pid_t pid, int signal);  ///< kill(2), or a stand-in

  /// `line` is for /bin/sh: `$1` in it is the level, the environment has the rest (`environment_of`). Its standard
  /// input is empty, its output goes to standard error.
  explicit AlertCommand(std::string line, std::chrono::milliseconds longest = kLongest, Kill kill = ::kill);
  /// Waits for the one that runs and for the one that waits.
  ~AlertCommand() override;
  AlertCommand(const AlertCommand&) = delete;
  AlertCommand& operator=(const AlertCommand&) = delete;

  void show(const AlertNow& alert, base::Time now) override;
  /// Runs it with level blind, unless its last level is stop or blind. Returns when no command is running or waiting,
  /// at the latest after twice `longest` and the grace after a kill.
  void end(base::Time now) override;
  std::vector<std::string> messages() override;

 private:
  void push(const AlertNow& alert);
  void work();
  /// Runs it to its end. What went wrong, without the level; empty if nothing did.
  [[nodiscard]] std::string run(const AlertNow& alert);
  [[nodiscard]] std::string end_hung(pid_t pid);
  void note(const std::string& fault, record::AlertLevel level);

  const std::string line_;
  const std::chrono::milliseconds longest_;
  const Kill kill_;
  std::vector<pid_t> given_up_;              ///< survived SIGKILL; of the thread
  std::optional<record::AlertLevel> level_;  ///< that was last pushed

  std::mutex mutex_;  ///< guards the members up to `thread_`
  std::condition_variable changed_;
  std::optional<AlertNow> due_;
  bool busy_ = false;
  bool stop_ = false;
  std::string last_fault_;
  std::vector<std::string> messages_;
  std::thread thread_;  ///< last, so that it starts when the others are there
};

/// "FENCEPOST_LEVEL=stop" and the others, in the order of live.md. What is not known is empty.
std::vector<std::string> environment_of(const AlertNow& alert);

}  // namespace fencepost::host
