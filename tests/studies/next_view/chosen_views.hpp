// One object looked at from chosen places, one view each.
#pragma once

#include <optional>
#include <vector>

#include "host/scene/scene.hpp"
#include "tests/studies/common/noise_levels.hpp"

namespace fencepost::test {

/// The outline after these views, and from where the robot says that it should be looked at next.
struct Looked {
  double recklessness = 1;
  double paranoia = 1;
  std::optional<double> next;  ///< rad, as seen from the object
  [[nodiscard]] double both() const { return recklessness + paranoia; }
};

/// The first object of objects_of_reference(seed), alone, and its camera.
host::Scene lone_object(unsigned seed);

/// From these bearings (rad, of the robot as seen from the object's middle), kViewDistance away, looking at it. The
/// noise of view i is the same whatever the views are. errors: throws std::runtime_error.
Looked look_from(const std::vector<double>& bearings, const host::Scene& object, const NoiseLevel& level);
inline constexpr double kViewDistance = 0.9;  ///< m

/// So many views, evenly on a circle, in the order in which a robot on it has them.
std::vector<double> evenly(int views);
/// The first at 0, then each where the robot wants the next one; without a wish, 100 degrees on.
std::vector<double> chosen(int views, const host::Scene& object, const NoiseLevel& level);

}  // namespace fencepost::test
