// Records of a WPILib data log (WPILOG, version 1.0; allwpilib, datalog/doc/datalog.adoc).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace fencepost::host {

struct WpilogRecord {
  std::string_view name;  ///< of its entry, such as NT:/SmartDashboard/Field/Robot
  std::string_view type;  ///< such as double[], struct:Pose2d
  double t = 0;           ///< s, of the robot's clock
  std::string_view data;
};

struct WpilogEnd {
  bool truncated = false;
  std::uint64_t unknown = 0;  ///< records of entries that were not started
};

/// Visits data records in the order of the file. A file that was cut off is read as far as it goes.
/// errors: ImportProblem: no WPILOG, another version, a damaged control record, too many entries
WpilogEnd read_wpilog(std::string_view bytes, const std::string& file,
                      const std::function<void(const WpilogRecord&)>& visit);

}  // namespace fencepost::host
