#include "host/doctor/log/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace fencepost::host::doctor {
namespace {

using Values = std::map<std::string, std::string>;

std::string exact(double value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

Values calibration_of(const LogSurvey& survey) {
  Values values;
  for (const auto& [signature, name] : survey.colour_names) values[fmt::format("signature {}", signature)] = name;
  if (survey.calibrations.empty()) return values;
  const sensor::CameraIntrinsics& camera = survey.calibrations.back();
  values["camera model"] = camera.model.view();
  values["camera size"] = fmt::format("{} x {}", camera.width, camera.height);
  values["camera fx"] = exact(camera.fx.to_double(), 2);
  values["camera fy"] = exact(camera.fy.to_double(), 2);
  values["camera cx"] = exact(camera.cx.to_double(), 2);
  values["camera cy"] = exact(camera.cy.to_double(), 2);
  values["camera k1"] = exact(camera.k1.to_double(), 4);
  values["camera lens"] = sensor::name(camera.lens);
  values["mount x"] = exact(camera.mount.x.to_double(), 4);
  values["mount y"] = exact(camera.mount.y.to_double(), 4);
  values["mount z"] = exact(camera.mount.z.to_double(), 4);
  values["mount yaw"] = exact(camera.mount.yaw.to_double(), 4);
  values["mount pitch"] = camera.mount.pitch ? exact(camera.mount.pitch->to_double(), 4) : "unknown";
  values["latency"] = exact(camera.latency.to_double(), 4);
  return values;
}

std::vector<ValueDifference> differing(const Values& first, const Values& second) {
  Values keys = first;
  keys.insert(second.begin(), second.end());
  std::vector<ValueDifference> list;
  for (const auto& entry : keys) {
    const auto value = [&](const Values& values) {
      const auto found = values.find(entry.first);
      return found == values.end() ? std::string() : found->second;
    };
    if (value(first) != value(second)) list.push_back({entry.first, value(first), value(second)});
  }
  return list;
}

double seconds(const record::AlertReport& alert) { return alert.t.to_double(); }

bool alike(const record::AlertReport& a, const record::AlertReport& b) {
  return std::abs(seconds(a) - seconds(b)) <= kSameTime &&
         std::abs((a.distance - b.distance).to_double()) <= kSameDistance;
}

void compare_alerts(const std::vector<record::AlertReport>& first, const std::vector<record::AlertReport>& second,
                    Difference& difference) {
  std::vector<bool> taken(second.size());
  for (const record::AlertReport& alert : first) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < second.size(); ++i) {
      const record::AlertReport& other = second[i];
      if (taken[i] || other.level != alert.level || other.signature != alert.signature) continue;
      const double apart = std::abs(seconds(other) - seconds(alert));
      if (apart > kPairTime) continue;
      if (!nearest || apart < std::abs(seconds(second[*nearest]) - seconds(alert))) nearest = i;
    }
    if (nearest) taken[*nearest] = true;
    if (nearest && alike(alert, second[*nearest])) {
      ++difference.alerts_alike;
    } else {
      difference.alerts.push_back({alert, nearest ? std::optional(second[*nearest]) : std::nullopt});
    }
  }
  for (std::size_t i = 0; i < second.size(); ++i) {
    if (!taken[i]) difference.alerts.push_back({std::nullopt, second[i]});
  }
  std::ranges::stable_sort(difference.alerts, {}, [](const AlertDifference& alert) {
    return alert.first ? seconds(*alert.first) : seconds(*alert.second);
  });
}

}  // namespace

Difference difference_of(const LogSurvey& first, const LogSurvey& second) {
  Difference difference;
  difference.settings = differing(first.settings, second.settings);
  difference.calibration = differing(calibration_of(first), calibration_of(second));
  compare_alerts(first.replayed.result.alerts, second.replayed.result.alerts, difference);
  return difference;
}

}  // namespace fencepost::host::doctor
