// A calibration drive of a robot that is configured rightly, but for one fault.
#pragma once

#include <string>
#include <string_view>

#include "host/calibrate/causes.hpp"
#include "tests/studies/calibrate/calibration_drive.hpp"

namespace fencepost::test {

enum class Fault { kNone, kPadAll, kPadOne, kTilt, kWidth, kTurns, kWays, kFocal, kYaw, kLatency, kHeight };
inline constexpr std::string_view kFaultNames[] = {"none", "pad",          "pad of one", "tilt",    "width", "turns",
                                                   "ways", "focal length", "yaw",        "latency", "height"};

/// Its log. `widths`: the log's FPSIG have them.
std::string faulty_drive(const DriveOptions& options, Fault fault, bool widths);

}  // namespace fencepost::test
