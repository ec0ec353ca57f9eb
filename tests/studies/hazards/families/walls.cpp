// Walls that do not fit into the image: no outline of them is ever seen.
#include <fmt/format.h>

#include <numbers>
#include <string>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kThick = 0.03;  // m

Outcome meet_wall(double length, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(1.2, 1.8);
  const double angle = dice.between(-std::numbers::pi / 3, std::numbers::pi / 3);
  const double aside = length * dice.between(-0.35, 0.35);
  const host::TimedPose face = relative(start, ahead, 0, angle);
  const double height = dice.between(0.1, 0.3);
  met.scene.objects = {
      thing("wall", random_colour(dice), height, box_at(relative(face, kThick / 2, aside), kThick, length))};
  drive_towards(dice, start, ahead, met);
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_approached(run, 0, outcome);
  judge_false_stops(run, outcome);
  return outcome;
}

Outcome drive_corridor(double half_width, unsigned seed, const Conditions& conditions) {
  constexpr double kLong = 16;    // m
  constexpr double kSpeed = 0.2;  // m/s
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose start = random_start(dice);
  const double off = dice.between(-0.03, 0.03);
  for (const double side : {-1.0, 1.0}) {
    const host::TimedPose center = relative(start, kLong / 2 - 1, off + side * (half_width + kThick / 2));
    const double height = dice.between(0.1, 0.3);
    met.scene.objects.push_back(thing("wall", random_colour(dice), height, box_at(center, kLong, kThick)));
  }
  met.route = Route(start, {{1, kSpeed, 0}});
  met.seconds = 71;
  return meet_nothing(met, conditions);
}

}  // namespace

Family walls() {
  Family family{"walls", "met head-on to 60 degrees, stop in force from 0.25 m to the contact", "first stop, m", {}};
  // Lost pieces make ends where the wall has none in the image: the level with clean boxes is the harder one.
  for (const std::string level : {"1", "2"}) {
    for (const double length : {0.4, 0.8, 1.5, 3.0, 6.0}) {
      family.cells.push_back(
          {fmt::format("{} m, level {}", length, level),
           {99.5, {}},  // by how much a stop may be early, the measure shows: each run ends at the wall
           [length](unsigned seed, const Conditions& conditions) { return meet_wall(length, seed, conditions); },
           level});
    }
  }
  return family;
}

Family corridors() {
  Family family{"corridors", "no stop and no complaint in 71 s at 0.2 m/s", "stops a run", {}};
  for (const double half : {0.3, 0.4, 0.6}) {
    family.cells.push_back(
        {fmt::format("half width {} m", half), {{}, 1}, [half](unsigned seed, const Conditions& conditions) {
           return drive_corridor(half, seed, conditions);
         }});
  }
  return family;
}

}  // namespace fencepost::test
