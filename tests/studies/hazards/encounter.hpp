// One robot and what it meets: all that a run needs, and nothing that was found out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/scene/scene.hpp"
#include "tests/studies/alerts/ground_truth.hpp"
#include "tests/studies/hazards/route.hpp"
#include "tests/studies/hazards/wire.hpp"

namespace fencepost::test {

/// What of the robot can touch, robot frame, m: a disc around the origin, or an outline.
struct Body {
  double radius = AlertLimits{}.half_width;
  std::optional<host::LinearRing> outline{};

  /// An outline from `rear` behind the origin to `front` ahead of it.
  static Body box(double front, double rear, double width);
};

struct Encounter {
  host::Scene scene;  ///< its path is not used
  Route route;
  double seconds = 0;  ///< the run ends then, or at a contact
  bool obeys = false;  ///< stands while it is told stop
  Body body;
  std::optional<sensor::CameraIntrinsics> told{};  ///< the calibration that the robot is told, where it is wrong
  std::vector<record::Setting> settings{};         ///< that the robot is told
  Outage outage{};
};

/// A brake that is pulled: this long until it acts, and this long from full speed to standing (s). By design, those of
/// small robots with geared motors.
inline constexpr double kReaction = 0.1;
inline constexpr double kBraking = 0.2;

}  // namespace fencepost::test
