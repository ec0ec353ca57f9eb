// From figures of a log to what is wrong, and what to try.
#pragma once

#include <numbers>
#include <vector>

#include "host/doctor/finding.hpp"
#include "host/doctor/log/survey.hpp"

namespace fencepost::host::doctor {

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// `makers`: the known cameras, as their makers describe them. `distances`: faults of distances whose cause was found.
/// They replace the robot's own complaint about them, which knows no cause.
Findings diagnose(const LogSurvey& survey, const std::vector<sensor::CameraIntrinsics>& makers,
                  const Findings& distances = {});

/// Its parts.
void diagnose_lines(const LogSurvey& survey, Findings& findings);
void diagnose_clock(const LogSurvey& survey, Findings& findings);
void diagnose_calibration(const LogSurvey& survey, const std::vector<sensor::CameraIntrinsics>& makers,
                          Findings& findings);
void diagnose_doubts(const LogSurvey& survey, Findings& findings);
void diagnose_colours(const LogSurvey& survey, Findings& findings);

}  // namespace fencepost::host::doctor
