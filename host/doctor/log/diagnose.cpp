#include "host/doctor/log/diagnose.hpp"

#include <fmt/format.h>

#include "host/text/plural.hpp"

namespace fencepost::host::doctor {
namespace {

using enum Severity;

constexpr double kManyForeign = 0.2;      // of all lines
constexpr double kSlowestCamera = 5;      // frames a second: k of n takes a second then
constexpr double kSlowestOdometry = 10;   // samples a second
constexpr std::uint64_t kAtTheEdges = 5;  // frames before the first pose and after the last one
constexpr double kLongestGap = 0.5;       // s, of odometry: frames in a longer one are refused

const char* reject_remedy(record::Reject reason) {
  switch (reason) {
    case record::Reject::kCrc: return "bytes were damaged or lost on the way: check cable, ground, baud rate and card";
    case record::Reject::kKind: return "records of a newer version: read it with that";
    case record::Reject::kFields:
    case record::Reject::kNumber: return "the CRC is right, so what writes them is wrong: see stream.md";
    case record::Reject::kRange: return "check units, and the image size in FPCAM";
    case record::Reject::kLength: return "line ends were lost: check what saved it";
    case record::Reject::kTruncated: return "the recording was cut off: end it before pulling the plug";
    case record::Reject::kTime: return "two recordings in one, or a clock that jumped back";
    case record::Reject::kFormat: return "use the release that wrote them";
  }
  return "";
}

std::uint64_t all_lines(const record::Counts& counts) { return counts.records + counts.foreign + counts.rejected(); }

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

void diagnose_rejects(const LogSurvey& survey, Findings& findings) {
  const auto lines = static_cast<double>(all_lines(survey.counts));
  for (std::size_t i = 0; i < record::kRejectReasons; ++i) {
    const auto reason = static_cast<record::Reject>(i);
    const record::RejectCount& reject = survey.counts.rejected(reason);
    if (reject.lines == 0) continue;
    const bool only_the_end = reason == record::Reject::kTruncated;
    findings.push_back({only_the_end ? kNote : kFault, Code::of(record::name(reason)),
                        fmt::format("{} rejected ({}), {:.2g} % of all, first in line {}", plural(reject.lines, "line"),
                                    record::name(reason), percent(reject.lines, lines), reject.first_line),
                        reject_remedy(reason)});
  }
  if (survey.counts.foreign > kManyForeign * lines) {
    findings.push_back(
        {kNote, "foreign",
         fmt::format("{:.0f} % of the lines are not the stream's", percent(survey.counts.foreign, lines)),
         "they cost time on a slow port: 'mode log' on the console says records only"});
  }
}

void diagnose_rates(const LogSurvey& survey, Findings& findings) {
  if (survey.camera.count == 0) {
    findings.push_back({kFault, "no_frames", "no frame of a camera", "run 'fencepost doctor' on the camera's port"});
  } else if (survey.camera.rate > 0 && survey.camera.rate < kSlowestCamera) {
    findings.push_back({kWarning, "slow_camera", fmt::format("{:.1f} frames a second", survey.camera.rate),
                        "alerts need 3 of 5 frames: raise the baud, or let the camera tell fewer blobs"});
  }
  if (survey.odometry.count == 0) {
    findings.push_back({kFault, "no_odometry", "no odometry", "run 'fencepost doctor' on the wheels' port"});
  } else if (survey.odometry.rate > 0 && survey.odometry.rate < kSlowestOdometry) {
    findings.push_back({kWarning, "slow_odometry", fmt::format("{:.1f} poses a second", survey.odometry.rate),
                        "poses between are interpolated: send them at least 20 times a second"});
  }
  if (survey.camera.gaps > 0) {
    findings.push_back({kWarning, "camera_gaps",
                        fmt::format("{} in the frames, the longest {:.2f} s at {:.2f} s",
                                    plural(survey.camera.gaps, "gap"), survey.camera.longest, survey.camera.longest_at),
                        "a loose plug, a camera that starts again, or a loop that waits"});
  }
  if (survey.odometry.gaps > 0) {
    const bool refused = survey.odometry.longest > kLongestGap;
    findings.push_back(
        {refused ? kFault : kWarning, "odometry_gaps",
         fmt::format("{} in the odometry, the longest {:.2f} s at {:.2f} s", plural(survey.odometry.gaps, "gap"),
                     survey.odometry.longest, survey.odometry.longest_at),
         refused ? "frames in gaps above 0.5 s are refused: find what holds the wheels' controller up"
                 : "find what holds the wheels' controller up"});
  }
}

void diagnose_refused(const RefusedFrames& refused, Findings& findings) {
  const auto add = [&](std::uint64_t count, const char* reason, const char* remedy) {
    if (count == 0) return;
    const bool edges = count <= kAtTheEdges && std::string_view(reason) == "no_pose";
    findings.push_back({edges ? kNote : kFault, Code::of(std::string("refused_") + reason),
                        fmt::format("{} refused: {}", plural(count, "frame"), reason), remedy});
  };
  add(refused.no_pose, "no_pose", "no odometry at their exposure: check latency and clocks");
  add(refused.odometry_gap, "odometry_gap", "odometry paused for more than 0.5 s");
  add(refused.no_camera, "no_camera", "no $FPCAM came before them");
}

void diagnose_losses(const LogSurvey& survey, Findings& findings) {
  if (survey.frames_missing > 0) {
    findings.push_back({kWarning, "frames_missing", plural(survey.frames_missing, "frame number") + " missing",
                        "the camera made them, nobody read them in time: a faster port, or a loop that waits less"});
  }
  const ReportedLosses& lost = survey.reported;
  if (lost.records_dropped > 0) {
    findings.push_back({kWarning, "records_dropped",
                        "the robot could not write " + plural(lost.records_dropped, "record"),
                        "raise the console's baud, or a faster card"});
  }
  if (lost.blobs_dropped > 0) {
    findings.push_back({kNote, "blobs_dropped", plural(lost.blobs_dropped, "blob") + " beyond 16 in a frame",
                        "train fewer colours, or raise the camera's least size of a blob"});
  }
  // Frames that the robot refused and its log does not have: no room to write them.
  const RefusedFrames& here = survey.replayed.result.log.refused;
  const std::uint64_t explained = here.no_pose + here.odometry_gap + here.no_camera;
  if (lost.refused > explained) {
    findings.push_back(
        {kFault, "refused_queue",
         fmt::format("the robot refused {} that it could not log", plural(lost.refused - explained, "frame")),
         "the console could not keep up: raise its baud, or a faster card"});
  }
  if (lost.rejected > 0) {
    findings.push_back({kWarning, "robot_rejected",
                        fmt::format("the robot rejected {} that came to it", plural(lost.rejected, "line")),
                        "check what sends them and the baud of that line"});
  }
}

void diagnose_links(const LogSurvey& survey, Findings& findings) {
  for (const auto& [device, trouble] : survey.links) {
    if (trouble.seconds < 0.1) continue;
    findings.push_back({kFault, Code::of("link_" + trouble.state),
                        fmt::format("{} did not work {}, {:.1f} s in all, last it was {}", device,
                                    plural(trouble.times, "time"), trouble.seconds, trouble.state),
                        trouble.state == "unready"
                            ? "it answers but cannot work: nothing trained, or still starting"
                            : "check its plug and its power, then 'fencepost doctor' on its port"});
  }
  if (survey.blind_seconds > 0.15) {
    findings.push_back({kFault, "blind", fmt::format("the robot was blind for {:.1f} s", survey.blind_seconds),
                        "no alert can be trusted then; the findings about rates and links say why"});
  }
}

}  // namespace

void diagnose_lines(const LogSurvey& survey, Findings& findings) {
  if (survey.counts.records == 0) {
    findings.push_back({kFault, "no_records", "no record of a robot in it",
                        "record in console mode log; other people's formats go through 'fencepost import'"});
    return;
  }
  diagnose_rejects(survey, findings);
  diagnose_rates(survey, findings);
  if (survey.replayed.unreadable && survey.camera.count > 0) {
    findings.push_back({kFault, "no_usable_frame", survey.replayed.unreadable->message, ""});
  }
  diagnose_refused(survey.replayed.result.log.refused, findings);
  diagnose_losses(survey, findings);
  diagnose_links(survey, findings);
}

Findings diagnose(const LogSurvey& survey, const std::vector<sensor::CameraIntrinsics>& makers,
                  const Findings& distances) {
  Findings findings;
  diagnose_lines(survey, findings);
  if (survey.counts.records == 0) return findings;
  diagnose_clock(survey, findings);
  diagnose_calibration(survey, makers, findings);
  if (distances.empty()) diagnose_doubts(survey, findings);
  findings.insert(findings.end(), distances.begin(), distances.end());
  diagnose_colours(survey, findings);
  return findings;
}

}  // namespace fencepost::host::doctor
