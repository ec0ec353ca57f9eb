// Console modes `text` and `plot`: what people and plotters read.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/alert/sight.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::console {

/// Any sentence fits into this many characters, line end included.
inline constexpr std::size_t kMaxSentence = 128;

/// "STOP    red  0.24 m  12 deg left  in 1.1 s\r\n". `name` is the signature's name, or empty. What is no object's
/// alert is of "something", or of "something red". Returns the length, 0 if `out` is too small.
std::size_t describe(const record::AlertReport& alert, std::string_view name, std::span<char> out);

/// "BLIND   no frame comes from the camera\r\n". Without a reason: the sentence for such an alert in a log.
std::size_t describe_blind(alert::Blindness reason, std::span<char> out);

/// The advice "check the camera's pitch and height: things are 1.31 times nearer than it tells". The first writes a
/// line of mode text, "CAMERA  check ...\r\n", the second a part of `status`.
std::size_t describe(const record::CalibrationDoubt& doubt, std::span<char> out);
std::size_t describe_calibration(const record::CalibrationDoubt& doubt, std::span<char> out);

/// The obstacle nearest to the robot.
struct Nearest {
  base::Metres distance;
  base::Radians bearing;
};

/// "dist_cm:83,bear_deg:-12,level:2,camera:4,odometry:4\r\n": a line for serial plotters. Degrees to the left are
/// positive. Level 0 to 4 (clear to blind) is the highest in force; the states 0 to 4 are absent to ok. Without a
/// nearest obstacle the line has only level and states. If the camera's calibration seems wrong, "doubt:1" (rows) or 2
/// (lens) follows.
std::size_t describe_plot(const std::optional<Nearest>& nearest, const record::Heartbeat& beat, record::Doubt doubt,
                          std::span<char> out);

/// "error: $FPODO rejected: ...": why a line that starts with $FP was not used.
std::size_t describe_reject(std::string_view line, record::Reject reason, std::string_view why, std::span<char> out);

}  // namespace fencepost::console
