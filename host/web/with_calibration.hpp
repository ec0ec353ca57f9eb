// A log with the calibration that it is short of.
#pragma once

#include <string>
#include <string_view>

#include "host/replay/replay.hpp"

namespace fencepost::host {

/// The bytes of a log in portions, with a further line in every run. The line follows the header, or comes before the
/// first record of a log that begins without one.
class WithCalibration {
 public:
  /// `line`: an FPCAM record with its line end.
  WithCalibration(LogSource log, std::string line) : log_(std::move(log)), line_(std::move(line)) {}

  /// They hold until the next call; none at the end.
  std::string_view next();

 private:
  void take(std::string_view bytes);
  void take_start();

  LogSource log_;
  std::string line_;
  std::string out_;
  std::string start_;      ///< of a line, as long as it is not known what it is
  bool in_line_ = false;   ///< behind its start
  bool header_ = false;    ///< it is one
  bool inserted_ = false;  ///< in this log
  bool ended_ = false;
};

}  // namespace fencepost::host
