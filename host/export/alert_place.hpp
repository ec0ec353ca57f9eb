// Where on the map an alert was about.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "host/result/result.hpp"

namespace fencepost::host::exports {

/// m, map frame: from the robot's last pose before it. Nothing of an alert without a place, or before any pose.
inline std::optional<Point> place_of(const ResultDocument& document, const record::AlertReport& alert) {
  if (!alert.has_place()) return std::nullopt;
  const auto after = std::upper_bound(document.path.begin(), document.path.end(), alert.t.to_double(),
                                      [](double t, const PoseResult& pose) { return t < pose.t; });
  if (after == document.path.begin()) return std::nullopt;
  const PoseResult& pose = *(after - 1);
  const double direction = pose.heading + alert.bearing.to_double();
  const double distance = alert.distance.to_double();
  return Point{pose.x + distance * std::cos(direction), pose.y + distance * std::sin(direction)};
}

}  // namespace fencepost::host::exports
