// Figures that a log gives about the robot that made it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/counts.hpp"
#include "host/doctor/log/colour_quality.hpp"
#include "host/doctor/log/spacing.hpp"
#include "host/recorder/losses.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host::doctor {

/// A step that no small robot makes.
struct PoseJump {
  double t = 0;
  double distance = 0;  ///< m
  double turn = 0;      ///< rad
  double interval = 0;  ///< s
};

/// How long a device did not work, by its FPLNK records.
struct LinkTrouble {
  std::string state;  ///< the last one in which it did not
  double seconds = 0;
  std::uint64_t times = 0;
};

struct LogSurvey {
  std::string name;
  record::Counts counts;
  double seconds = 0;      ///< of stream time, all runs together
  std::uint64_t runs = 0;  ///< FPHDR records, at least 1
  Spacing camera;
  Spacing odometry;
  std::vector<ColourQuality> colours;
  std::map<std::uint8_t, std::string> colour_names;
  std::vector<sensor::CameraIntrinsics> calibrations;  ///< each that was in force, in order
  std::map<std::string, std::string> settings;         ///< as in force at the end
  std::uint64_t pose_jumps = 0;
  std::optional<PoseJump> first_jump;
  double path = 0;                           ///< m, driven
  double turned = 0;                         ///< rad, magnitudes added
  double clock_offset = 0;                   ///< s, median of a frame's time minus the odometry's before it
  std::optional<double> clock_drift;         ///< s, of that, from the first third of the frames to the last
  std::map<std::string, LinkTrouble> links;  ///< by device
  double blind_seconds = 0;                  ///< by the robot's own heartbeat
  std::uint64_t frames_missing = 0;          ///< numbers passed over
  ReportedLosses reported;                   ///< by FPSTA
  ReplayOutcome replayed;                    ///< by the robot's own loop at this desk
};

/// Reads the log once, in memory that does not grow with it: rates and medians of a long log are of a sample. Of alerts
/// it keeps the first 65,536.
LogSurvey survey_log(const LogSource& log, const std::string& name);
LogSurvey survey_log(std::string_view bytes, const std::string& name);

}  // namespace fencepost::host::doctor
