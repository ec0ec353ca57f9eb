#include <fmt/format.h>

#include <cmath>

#include "host/doctor/log/diagnose.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::doctor {
namespace {

using enum Severity;

constexpr double kLargestOffset = 0.5;  // s: a frame waits no longer than 0.2 s for its pose
constexpr double kLargestDrift = 0.05;  // s over a log: as much as a camera's latency
constexpr double kStandsStill = 0.02;   // m, and rad
constexpr double kLongEnough = 5;       // s

}  // namespace

void diagnose_clock(const LogSurvey& survey, Findings& findings) {
  if (survey.runs > 1) {
    findings.push_back({kNote, "runs", fmt::format("{} runs in one log", survey.runs),
                        "each begins from nothing; if nobody started them, the robot booted again: check its supply"});
  }
  const bool both = survey.camera.count > 0 && survey.odometry.count > 0;
  if (both && std::abs(survey.clock_offset) > kLargestOffset) {
    findings.push_back({kFault, "clock_offset",
                        fmt::format("frames are {:.2f} s {} the odometry beside them", std::abs(survey.clock_offset),
                                    survey.clock_offset > 0 ? "ahead of" : "behind"),
                        "two clocks: stamp both on the robot, or leave the t of FPODO empty"});
  } else if (both && survey.clock_drift && std::abs(*survey.clock_drift) > kLargestDrift) {
    findings.push_back({kFault, "clock_drift",
                        fmt::format("the clocks of frames and odometry went apart by {:.2f} s", *survey.clock_drift),
                        "two clocks: stamp both on the robot, or leave the t of FPODO empty"});
  }
  if (survey.first_jump) {
    findings.push_back(
        {kFault, "odometry_jumps",
         fmt::format("the pose jumped {}, first at {:.2f} s: {:.2f} m and {:.0f} deg in {:.2f} s",
                     plural(survey.pose_jumps, "time"), survey.first_jump->t, survey.first_jump->distance,
                     degrees(survey.first_jump->turn), survey.first_jump->interval),
         "a counter that wrapped or was reset, wrong units, or somebody carried the robot"});
  }
  const bool stood = survey.path < kStandsStill && survey.turned < kStandsStill;
  if (survey.odometry.count > 1 && stood && survey.seconds > kLongEnough) {
    findings.push_back({kWarning, "odometry_still", "the odometry never moved",
                        "if the robot did: check the encoders' plug, and the counts per turn"});
  }
}

}  // namespace fencepost::host::doctor
