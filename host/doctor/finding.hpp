// The doctor's findings, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::doctor {

enum class Severity : std::uint8_t {
  kNote,     ///< worth knowing
  kWarning,  ///< the map or the alerts are worse for it
  kFault,    ///< something does not work
};

constexpr std::string_view name(Severity severity) {
  switch (severity) {
    case Severity::kNote: return "note";
    case Severity::kWarning: return "warning";
    case Severity::kFault: return "fault";
  }
  return "note";
}

/// All codes of findings, stable. A test provokes each, and share/doc/doctor.md explains it.
inline constexpr std::string_view kCodes[] = {
    // ports
    "no_port", "no_permission", "busy", "answers", "cannot_open", "wrong_baud", "silent", "unready", "nothing_seen",
    "fine",
    // lines
    "no_records", "crc", "kind", "fields", "number", "range", "length", "truncated", "time", "format", "foreign",
    // frames and odometry
    "no_frames", "no_odometry", "slow_camera", "slow_odometry", "camera_gaps", "odometry_gaps", "frames_missing",
    "no_usable_frame", "refused_no_pose", "refused_odometry_gap", "refused_no_camera", "refused_queue",
    // clocks and wheels
    "runs", "clock_offset", "clock_drift", "odometry_jumps", "odometry_still",
    // calibration
    "no_calibration", "calibration_field_of_view", "calibration_oblong", "calibration_centre", "calibration_height",
    "calibration_pitch_unknown", "calibration_pitch", "calibration_latency", "calibration_size", "calibration_lens",
    "calibration_changed", "calibration_rows", "calibration_focal_length",
    // distances
    "distance_pad", "distance_width", "distance_focal_length", "distance_pitch", "distance_yaw", "distance_height",
    "distance_latency", "distance_ways", "distance_turns", "distance_curve",
    // colours
    "colour_unnamed", "colour_flicker", "colour_jitter", "colour_pieces",
    // the robot's own remarks
    "records_dropped", "blobs_dropped", "robot_rejected", "link_absent", "link_silent", "link_unready", "blind"};

/// One of kCodes; another word does not compile.
class Code {
 public:
  constexpr Code() = default;
  consteval Code(const char* word) : word_(listed(word)) {}  // NOLINT(google-explicit-constructor): findings read so
  /// A code that is composed at run time. errors: std::logic_error, if kCodes does not list it
  static Code of(std::string_view word);

  [[nodiscard]] std::string str() const { return std::string(word_); }
  friend bool operator==(const Code& code, std::string_view word) { return code.word_ == word; }
  friend std::ostream& operator<<(std::ostream& out, const Code& code) { return out << code.word_; }

 private:
  static constexpr std::string_view listed(std::string_view word) {
    for (const std::string_view code : kCodes) {
      if (code == word) return code;
    }
    throw std::logic_error("a finding that kCodes does not list");
  }

  std::string_view word_;
};

struct Finding {
  Severity severity = Severity::kNote;
  Code code;
  std::string what;    ///< a clause, with its figures
  std::string remedy;  ///< for the user to try; may be empty
};
using Findings = std::vector<Finding>;

bool has_fault(const Findings& findings);

/// "FAULT    what; remedy" a line, the worst first; of none nothing.
std::string findings_text(const Findings& findings);

/// [{"severity", "code", "what", "remedy"}], the worst first.
nlohmann::ordered_json findings_json(const Findings& findings);

}  // namespace fencepost::host::doctor
