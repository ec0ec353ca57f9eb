// Feet that are not on the floor or not seen, and a camera that is not as configured.
#include <fmt/format.h>

#include <numbers>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

struct Wrong {
  double base = 0;    ///< m above the floor
  bool grey = false;  ///< an untrained box hides its foot
  double pitch = 0;   ///< degrees, true minus configured
  double lens = 1;    ///< focal length, configured over true
};

// A listener that says that the calibration cannot be right has kept its promise. With nothing configured wrong, none
// complains in these scenes.
bool complains_of_camera(const History& history) { return !history.complaints.empty(); }

Outcome meet(const Wrong& wrong, unsigned seed, const Conditions& conditions) {
  constexpr double kDegree = std::numbers::pi / 180;
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions);
  met.scene.noise.pitch_error = wrong.pitch * kDegree;
  const host::TimedPose start = random_start(dice);
  const double ahead = dice.between(0.9, 1.4);
  const double left = dice.between(-0.05, 0.05);
  host::SceneObject block = random_block(dice, start, ahead, left);
  block.base = wrong.base;
  met.scene.objects = {block};
  if (wrong.grey) {
    host::SceneObject grey = thing("grey", 0, 0.04, box_at(relative(start, ahead - 0.02, left), 0.02, 0.4));
    grey.trained = false;
    met.scene.objects.push_back(grey);
  }
  if (wrong.lens != 1) {
    met.configured = met.scene.camera;
    met.configured->fx = met.configured->fy = base::Pixels2::nearest(wrong.lens * met.scene.camera.fx.to_double());
  }
  drive_towards(dice, start, ahead, met);
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  judge_approached(run, 0, outcome);
  judge_false_stops(run, outcome);
  if (wrong.lens != 1 && complains_of_camera(run.history)) outcome.kept = outcome.asked;
  return outcome;
}

}  // namespace

Family bases() {
  Family family{"bases", "stop in force from 0.25 m to the contact; lens: or a complaint", "first stop, m", {}};
  const auto add = [&](std::string scene, const Wrong& wrong) {
    family.cells.push_back({std::move(scene), {97, {}}, [wrong](unsigned seed, const Conditions& conditions) {
                              return meet(wrong, seed, conditions);
                            }});
  };
  for (const int base : {0, 3, 5, 8}) add(fmt::format("{} cm above the floor", base), {.base = base / 100.0});
  add("foot behind a grey box", {.grey = true});
  for (const double pitch : {-2, -1, 1, 2}) add(fmt::format("true pitch {:+} degrees", pitch), {.pitch = pitch});
  add("lens configured 1.45 times too long", {.lens = 1.45});
  return family;
}

}  // namespace fencepost::test
