// Moments in which the robot cannot know what is ahead.
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

constexpr double kBegins = 5;    // s
constexpr double kSeconds = 15;  // s, of a run
constexpr double kLimit = 1;     // s, until it has to be reported, and until that is over

// Blocks on either side of the way; none is in it, so no stop is about one.
void add_avenue(Dice& dice, const host::TimedPose& start, host::Scene& scene) {
  constexpr int kBlocks = 10;
  constexpr double kApart = 0.6;  // m
  for (int i = 0; i < kBlocks; ++i) {
    const double left = (i % 2 == 0 ? 1 : -1) * dice.between(0.4, 0.6);
    scene.objects.push_back(random_block(dice, start, 0.8 + i * kApart, left));
  }
}

Outcome go_blind(Fault fault, double lasts, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose start = random_start(dice);
  add_avenue(dice, start, met.scene);
  met.route = Route(start, {{1, dice.between(0.15, 0.3), 0}});
  met.seconds = kSeconds;
  met.outage = {fault, kBegins, lasts > 0 ? kBegins + lasts : met.outage.until};
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_told(run, kBegins, met.outage.until, kLimit, outcome);
  return outcome;
}

// All is well: nothing is to be said of a room without blocks, nor of an image that stays the same because nothing
// moves.
Outcome see_well(bool drives, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  const host::TimedPose start = random_start(dice);
  if (drives) {
    met.route = Route(start, {{1, dice.between(0.15, 0.3), 0}});
  } else {
    met.scene.noise = {};
    met.route = Route(start, {});
    add_avenue(dice, start, met.scene);
  }
  met.seconds = kSeconds;
  return meet_nothing(met, conditions);
}

}  // namespace

Family blind() {
  Family family{
      "blind",
      "a stop, or that it is blind, in force 1 s after the fault began, and nothing 1 s after its end; all well: none",
      "s until reported, of 10; all well: stops",
      {}};
  const auto add = [&](std::string scene, Fault fault, double lasts = 0) {
    family.cells.push_back({std::move(scene), {99.5, {}}, [fault, lasts](unsigned seed, const Conditions& conditions) {
                              return go_blind(fault, lasts, seed, conditions);
                            }});
  };
  add("camera silent", Fault::kCameraSilent);
  add("camera silent for 3 s", Fault::kCameraSilent, 3);
  add("camera frozen while driving", Fault::kCameraFrozen);
  add("boxes outside the image", Fault::kCameraNonsense);
  add("odometry silent while driving", Fault::kOdometrySilent);
  add("odometry silent for 3 s", Fault::kOdometrySilent, 3);
  for (const bool drives : {true, false}) {
    family.cells.push_back(
        {drives ? "all well, an empty room" : "all well, standing, without noise",
         {99.5, 1},
         [drives](unsigned seed, const Conditions& conditions) { return see_well(drives, seed, conditions); }});
  }
  return family;
}

}  // namespace fencepost::test
