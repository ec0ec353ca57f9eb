#include "tests/studies/ways/arena.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/studies/alerts/approach.hpp"
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kBetween = 0.45;  // m, from thing to thing: a robot of 0.2 m with its margins, and some more
// Two boards of 0.5 m at a right angle, and the robot looks into the corner that they make.
void add_corner(Dice& dice, const host::TimedPose& start, host::Scene& scene) {
  constexpr double kBoard = 0.5;
  constexpr double kThickness = 0.03;
  const double away = dice.between(0.45, 0.7);
  for (const double turn : {-0.25, 0.25}) {
    const double heading = start.heading + turn * std::numbers::pi;
    const host::TimedPose corner = relative(start, away, 0);
    const host::TimedPose middle{0, corner.x - kBoard / 2 * std::cos(heading),
                                 corner.y - kBoard / 2 * std::sin(heading), heading};
    scene.objects.push_back(
        thing("board", random_colour(dice), dice.between(0.1, 0.2), box_at(middle, kBoard, kThickness)));
  }
}

double nearest(const host::Scene& scene, const host::Point& place) {
  double least = 1e9;
  for (const host::SceneObject& object : scene.objects) {
    least = std::min(least, distance_to(object.footprint, place));
  }
  return least;
}

}  // namespace

Arena random_arena(unsigned seed, const NoiseLevel& level) {
  Dice dice(seed);
  Arena arena;
  arena.scene = bare_scene(seed, {level}, {60, dice.between(0.12, 0.2), dice.between(0, 0.2)});
  const double half = dice.between(1.2, 2);
  arena.start = {0, dice.between(-half, half), dice.between(-half, half),
                 dice.between(-std::numbers::pi, std::numbers::pi)};
  add_corner(dice, arena.start, arena.scene);
  const unsigned things = 6 + dice.below(7);
  for (int attempt = 0; attempt < 200 && arena.scene.objects.size() < 2 + things; ++attempt) {
    const host::TimedPose place{0, dice.between(-half, half), dice.between(-half, half), 0};
    constexpr double kLargest = 0.15;  // m, from the middle of a thing to its end
    const bool far_enough = nearest(arena.scene, {place.x, place.y}) > kBetween + kLargest &&
                            std::hypot(place.x - arena.start.x, place.y - arena.start.y) > kBetween + kLargest;
    if (far_enough) arena.scene.objects.push_back(random_block(dice, place, 0, 0));
  }
  return arena;
}

bool touches(const Arena& arena, const host::Point& place, double radius) {
  return nearest(arena.scene, place) < radius;
}

}  // namespace fencepost::test
