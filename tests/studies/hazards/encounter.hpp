// One robot and the things that it meets: all inputs of a run, and none of its results.
#pragma once

#include <optional>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/scene/scene.hpp"
#include "tests/studies/alerts/ground_truth.hpp"
#include "tests/studies/hazards/route.hpp"
#include "tests/studies/hazards/wire.hpp"

namespace fencepost::test {

/// The part of the robot that can touch, robot frame, m: a disc around the origin, or an outline.
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
  bool obeys = false;  ///< stands while a stop is in force
  bool slows = false;  ///< and is no faster than the speed limit
  Brake brake{};
  Body body;
  std::optional<sensor::CameraIntrinsics> configured{};  ///< the configured calibration, where it is wrong
  std::vector<record::Setting> settings{};               ///< configured
  Outage outage{};
};

}  // namespace fencepost::test
