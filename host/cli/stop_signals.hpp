// Signals that ask a running loop to stop, for commands that have something to bring to an end first.
#pragma once

#include <csignal>

namespace fencepost::host::cli {

/// While it lives, SIGINT, SIGTERM and SIGHUP set `caught` instead of ending the program; a second one ends it. One
/// that was ignored (nohup) stays ignored. One object at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// 0, or the number of the signal.
  [[nodiscard]] static const volatile std::sig_atomic_t& caught();
};

}  // namespace fencepost::host::cli
