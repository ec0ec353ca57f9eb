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

/// A brake that is pulled: `reaction` s until it acts, and `full` s from the route's speed to standing. By design, that
/// of small robots with geared motors.
struct Brake {
  double reaction = 0.1;
  double full = 0.2;
};

struct Encounter {
  host::Scene scene;  ///< its path is not used
  Route route;
  double seconds = 0;  ///< the run ends then, or at a contact
  bool obeys = false;  ///< stands while it is told stop
  bool slows = false;  ///< and is no faster than the speed limit
  Brake brake{};
  Body body;
  std::optional<sensor::CameraIntrinsics> told{};  ///< the calibration that the robot is told, where it is wrong
  std::vector<record::Setting> settings{};         ///< that the robot is told
  Outage outage{};
};

}  // namespace fencepost::test
