// A robot that obeys: it stands before the obstacle, which has sunk below the image by then.
#include <fmt/format.h>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kStanding = 20;  // s
constexpr double kNear = 0.3;     // m
constexpr double kLowest = 0.03;  // m: a thing this low leaves the image before the robot stands

struct Before {
  double wall = 0;  ///< m, its length; 0: a block
  double rate = 25;
  std::optional<Lens> lens{};  ///< none: a random one
};

Lens random_lens(Dice& dice) {
  const double height = dice.between(0.12, 0.30);
  return {43, height, dice.between(0, 0.35)};
}

Outcome obey(const Before& before, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  const Lens lens = random_lens(dice);
  Encounter met;
  met.scene = bare_scene(seed, conditions, before.lens.value_or(lens), before.rate);
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(0.8, 1.3);
  const double left = dice.between(-0.05, 0.05);
  if (before.wall > 0) {
    const host::TimedPose center = relative(start, ahead + 0.015, left, dice.between(-0.5, 0.5));
    const double height = dice.between(kLowest, 0.2);
    met.scene.objects = {thing("wall", random_colour(dice), height, box_at(center, 0.03, before.wall))};
  } else {
    met.scene.objects = {random_block(dice, start, ahead, left, kLowest)};
  }
  const double speed = dice.between(0.1, 0.4);
  met.route = Route(start, {{0.5, 0, 0}, {1, speed, 0}});
  met.obeys = true;
  met.seconds = 0.5 + ahead / speed + kStanding;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_silence(run, 0, kNear, outcome);
  judge_false_stops(run, outcome);
  return outcome;
}

}  // namespace

Family obeying() {
  Family family{"obeying",
                "no contact, and a warn or stop in force while the obstacle is within 0.3 m",
                "times clear within 0.3 m",
                {}};
  const auto add = [&](std::string scene, const Before& before) {
    family.cells.push_back({std::move(scene), {99.5, {}}, [before](unsigned seed, const Conditions& conditions) {
                              return obey(before, seed, conditions);
                            }});
  };
  add("block, any lens, 10 frames/s", {0, 10});
  add("block, any lens, 50 frames/s", {0, 50});
  add("wall of 1.5 m, any lens, 10 frames/s", {1.5, 10});
  add("wall of 1.5 m, any lens, 50 frames/s", {1.5, 50});
  for (const double height : {0.12, 0.30}) {
    for (const double pitch : {0.0, 0.35}) {
      add(fmt::format("block, lens {} m high, pitch {}", height, pitch), {0, 25, Lens{43, height, pitch}});
    }
  }
  return family;
}

}  // namespace fencepost::test
