// How a command ends.
#pragma once

#include <stdexcept>
#include <string>

namespace fencepost::host::cli {

enum class Exit : int {
  kDone = 0,
  kCheckFailed = 1,
  kUsage = 2,
  kUnreadable = 3,  ///< input that cannot be read, or holds nothing usable
  kDevice = 4,      ///< a port, a device, or an output that cannot be written
  kInterrupted = 130,
};

/// Ends the command. The message says what, where, and what to try next.
class Failure : public std::runtime_error {
 public:
  Failure(Exit code, const std::string& message) : std::runtime_error(message), code_(code) {}
  [[nodiscard]] Exit code() const { return code_; }

 private:
  Exit code_;
};

}  // namespace fencepost::host::cli
