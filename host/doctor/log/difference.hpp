// Compares two runs: settings, calibration, and the results of the robot's own loop.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

#include "host/doctor/log/survey.hpp"

namespace fencepost::host::doctor {

/// One of the two is empty where the other run alone has it.
struct ValueDifference {
  std::string key;  ///< "alert.stop", "camera fx", "signature 1"
  std::string first;
  std::string second;
};

/// Alerts of one object's signature and level that were paired, or that one run alone has.
struct AlertDifference {
  std::optional<record::AlertReport> first;
  std::optional<record::AlertReport> second;
};

struct Difference {
  std::vector<ValueDifference> settings;
  std::vector<ValueDifference> calibration;  ///< the last FPCAM of each, and the colours' names
  std::vector<AlertDifference> alerts;
  std::size_t alerts_alike = 0;
  [[nodiscard]] bool any() const { return !settings.empty() || !calibration.empty() || !alerts.empty(); }
};

/// Alerts are alike within kSameTime and kSameDistance; a pair is of one level and signature, in order of time.
inline constexpr double kSameTime = 0.05;      ///< s
inline constexpr double kSameDistance = 0.02;  ///< m
inline constexpr double kPairTime = 1;         ///< s: farther apart they are two alerts
Difference difference_of(const LogSurvey& first, const LogSurvey& second);

std::string difference_text(const Difference& difference, const std::string& first, const std::string& second);
nlohmann::ordered_json difference_json(const Difference& difference);

}  // namespace fencepost::host::doctor
