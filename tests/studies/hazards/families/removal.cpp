// The obstacle before which the robot stands is taken away.
#include <fmt/format.h>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

enum class Behind : unsigned char { kNothing, kWall, kBox };

std::string_view name(Behind behind) {
  switch (behind) {
    case Behind::kNothing: return "nothing";
    case Behind::kWall: return "a wall";
    case Behind::kBox: return "a box";
  }
  return "nothing";
}

Outcome take_away(Behind behind, double rate, unsigned seed, const Conditions& conditions) {
  constexpr double kWatched = 16;      // s, afterwards
  constexpr double kLimit = 1;         // s
  constexpr double kBackground = 0.5;  // m beyond it: an alert about something there is not about it
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions, {}, rate);
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(1.0, 1.4);
  const double stands = dice.between(0.3, 0.45);  // m before it
  host::SceneObject block = random_block(dice, start, ahead, dice.between(-0.05, 0.05));
  const double speed = dice.between(0.1, 0.4);
  const double arrives = 0.5 + (ahead - stands) / speed;
  const double gone = arrives + 3;
  block.until = gone;
  met.scene.objects = {block};
  // Farther from the robot than alert.notice.
  const host::TimedPose back = relative(start, ahead - stands + dice.between(1.3, 1.6), 0);
  const double height = dice.between(0.1, 0.3);
  const std::uint8_t colour = random_colour(dice);
  if (behind == Behind::kWall) met.scene.objects.push_back(thing("wall", colour, height, box_at(back, 0.03, 3)));
  if (behind == Behind::kBox) met.scene.objects.push_back(thing("box", colour, height, box_at(back, 0.2, 0.3)));
  met.route = Route(start, {{0.5, 0, 0}, {arrives - 0.5, speed, 0}, {1, 0, 0}});
  met.seconds = gone + kWatched;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_removal(run, block.signature, gone, kLimit, stands + kBackground, outcome);
  return outcome;
}

}  // namespace

Family removal() {
  Family family{
      "removal", "an alert before, and none 1 s after it was taken away", "s until all alerts have gone, of 16", {}};
  for (const Behind behind : {Behind::kNothing, Behind::kWall, Behind::kBox}) {
    for (const double rate : {12.5, 50.0}) {
      family.cells.push_back({fmt::format("{} behind, {} frames/s", name(behind), rate),
                              {99, {}},
                              [behind, rate](unsigned seed, const Conditions& conditions) {
                                return take_away(behind, rate, seed, conditions);
                              }});
    }
  }
  return family;
}

}  // namespace fencepost::test
