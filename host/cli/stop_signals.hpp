// Signals that ask a running loop to stop, for commands that have something to bring to an end first.
#pragma once

#include <csignal>
#include <optional>

#include "hal/linux/signal_flag.hpp"

namespace fencepost::host::cli {

/// During its lifetime SIGINT, SIGTERM and SIGHUP set `caught` instead of ending the program; a second SIGINT or
/// SIGTERM ends it. One that was ignored (nohup) stays ignored. One object at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// 0, or the number of the signal.
  [[nodiscard]] static const volatile std::sig_atomic_t& caught();
  /// For WaitSet: readable once one was caught, so that a signal that comes just before sleeping is not slept over.
  [[nodiscard]] int descriptor() const { return flag_ ? flag_->descriptor() : -1; }
  /// Called before a second signal ends the program; within a signal handler, with all that this forbids.
  void on_second(void (*undo)());

 private:
  std::optional<linux::SignalFlag> flag_;
};

}  // namespace fencepost::host::cli
