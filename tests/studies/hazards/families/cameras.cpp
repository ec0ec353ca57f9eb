// A room with blocks all around, and a camera that is not as configured, or is: who finds out, and who cries wolf.
#include <fmt/format.h>

#include <numbers>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

struct Error {
  double pitch = 0;  ///< degrees, true minus configured
  double lens = 1;   ///< focal length, configured over true
  double degrees = 60;
};

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kBlocks = 6;
constexpr double kSeconds = 90;

// Spins twice, then drives at the blocks one by one, as far as to half a metre, backs off and turns on.
Route look_around(Dice& dice, const host::TimedPose& start) {
  const double spin = dice.between(0.5, 1.2);
  std::vector<Leg> legs = {{0.5, 0, 0}, {4 * std::numbers::pi / spin, 0, spin}};
  for (int i = 0; i < kBlocks; ++i) {
    const double speed = dice.between(0.15, 0.3);
    const double way = 0.75;
    legs.push_back({way / speed, speed, 0});
    legs.push_back({way / speed, -speed, 0});
    legs.push_back({2 * std::numbers::pi / kBlocks / spin, 0, spin});
  }
  legs.push_back({1, 0, 0});
  return {start, legs};
}

Outcome meet(const Error& error, unsigned seed, const Conditions& conditions) {
  Dice dice(seed);
  Encounter met;
  met.scene = bare_scene(seed, conditions, {.degrees = error.degrees});
  met.scene.noise.pitch_error = error.pitch * kDegree;
  const host::TimedPose start = random_start(dice);
  const double first = dice.between(-0.2, 0.2);
  for (int i = 0; i < kBlocks; ++i) {
    const host::TimedPose way =
        relative(start, 0, 0, first + 2 * std::numbers::pi * i / kBlocks + dice.between(-0.25, 0.25));
    met.scene.objects.push_back(random_block(dice, way, dice.between(1.05, 1.4), dice.between(-0.05, 0.05)));
  }
  if (error.lens != 1) {
    met.configured = met.scene.camera;
    met.configured->fx = met.configured->fy = base::Pixels2::nearest(error.lens * met.scene.camera.fx.to_double());
  }
  met.route = look_around(dice, start);
  met.seconds = kSeconds;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  const bool wrong = error.pitch != 0 || error.lens != 1;
  outcome.seconds = run.history.end;
  outcome.asked = 1;
  outcome.kept = run.history.complaints.empty() != wrong ? 1 : 0;
  outcome.measures.push_back(static_cast<double>(run.history.complaints.size()));
  if (outcome.kept == 0) {
    outcome.failures.push_back(wrong ? "no complaint about the camera" : run.history.complaints.front());
  }
  return outcome;
}

}  // namespace

Family cameras() {
  Family family{"cameras", "a complaint about a camera that is wrong, none about one that is right", "complaints", {}};
  const auto add = [&](std::string scene, double target, const Error& error) {
    family.cells.push_back({std::move(scene), {target, {}}, [error](unsigned seed, const Conditions& conditions) {
                              return meet(error, seed, conditions);
                            }});
  };
  add("as configured", 100, {});
  add("as configured, 43 degrees of view", 100, {.degrees = 43});
  for (const int pitch : {-4, -2, 2, 4}) add(fmt::format("true pitch {:+} degrees", pitch), 90, {.pitch = pitch * 1.0});
  for (const double lens : {1.45, 1.25, 0.8}) {
    add(fmt::format("lens configured {:.2f} times too long", lens), 90, {.lens = lens});
  }
  return family;
}

}  // namespace fencepost::test
