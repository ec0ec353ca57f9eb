// The records with which a later part of a log must begin, so that it can be read by itself.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace fencepost::host {

/// Follows the lines of a log and knows which FPCAM, FPSIG and FPCFG are in force after them.
class CalibrationLines {
 public:
  /// Whether `note` would remember something of this line.
  [[nodiscard]] static bool is_one(std::string_view line);
  /// One line, line end included.
  void note(std::string_view line);
  /// Those in force, a line each, in the order of the stream: camera, signatures, settings. Without FPHDR: a new part
  /// is no new run.
  [[nodiscard]] std::string in_force() const;

 private:
  std::string camera_;
  std::map<int, std::string> signatures_;  ///< by number
  std::map<std::string, std::string, std::less<>> settings_;
};

}  // namespace fencepost::host
