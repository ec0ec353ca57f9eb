// The random approaches of the alert study, through the table's judges.
#include <fmt/format.h>

#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

Outcome approach(double degrees, unsigned seed, const Conditions& conditions) {
  const Approach random = random_approach(seed, conditions.level, AlertLimits{}.warn);
  if (random.scene.objects.empty()) return {};
  Encounter met;
  met.scene = random.scene;
  met.scene.camera.fx = met.scene.camera.fy = bare_scene(seed, conditions, {.degrees = degrees}).camera.fx;
  met.scene.rate = conditions.rate.value_or(random.scene.rate);
  const Drive& drive = random.drive;
  met.route = Route(drive.start, {{drive.standing, 0, 0}, {1, drive.speed, drive.speed * drive.curvature}});
  met.seconds = random.end;
  Outcome outcome;
  const Judged run = run_cell(met, conditions);
  for (std::size_t object = 0; object < met.scene.objects.size(); ++object) judge_approached(run, object, outcome);
  judge_false_stops(run, outcome);
  return outcome;
}

}  // namespace

Family approaches() {
  Family family{"approaches", "stop in force from 0.25 m to the contact", "first stop, m", {}};
  for (const double degrees : {43.0, 60.0}) {
    for (const NoiseLevel& level : noise_levels()) {
      const Target target = level.key == "2" ? Target{99.5, 1} : Target{};
      family.cells.push_back(
          {fmt::format("level {}, {} degrees", level.key, degrees), target,
           [degrees](unsigned seed, const Conditions& conditions) { return approach(degrees, seed, conditions); },
           std::string(level.key)});
    }
  }
  return family;
}

}  // namespace fencepost::test
