#include "tests/studies/hazards/scenery.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"

namespace fencepost::test {
namespace {

constexpr int kColours = 4;

}  // namespace

host::Scene bare_scene(unsigned seed, const Conditions& conditions, const Lens& lens, double rate) {
  host::Scene scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  const double half = lens.degrees * std::numbers::pi / 360;
  scene.camera.fx = scene.camera.fy = base::Pixels2::nearest(scene.camera.width / 2.0 / std::tan(half));
  scene.camera.mount.z = base::Metres::nearest(lens.height);
  scene.camera.mount.pitch = base::Radians::nearest(lens.pitch);
  scene.camera.latency = base::Duration::nearest(0.05);
  scene.rate = conditions.rate.value_or(rate);
  scene.noise = scene_noise(conditions.level);
  for (std::uint8_t id = 1; id <= kColours; ++id) scene.signatures.push_back({id, "colour " + std::to_string(id), {}});
  return scene;
}

host::TimedPose random_start(Dice& dice) {
  const double x = dice.between(-5, 5);
  const double y = dice.between(-5, 5);
  return {0, x, y, dice.between(-std::numbers::pi, std::numbers::pi)};
}

std::uint8_t random_colour(Dice& dice) { return static_cast<std::uint8_t>(1 + dice.below(kColours)); }

host::Polygon box_at(const host::TimedPose& center, double depth, double width) {
  const double a = depth / 2;
  const double b = width / 2;
  return host::moved({{{-a, -b}, {a, -b}, {a, b}, {-a, b}}, {}}, center.heading, {center.x, center.y});
}

host::SceneObject thing(std::string name, std::uint8_t colour, double height, host::Polygon footprint) {
  host::SceneObject object;
  object.name = std::move(name);
  object.signature = colour;
  object.height_m = height;
  object.footprint = std::move(footprint);
  return object;
}

host::SceneObject random_block(Dice& dice, const host::TimedPose& base, double ahead, double left, double lowest) {
  const double turn = dice.between(0, 2 * std::numbers::pi);
  const host::Polygon shape = host::moved({random_footprint(dice), {}}, turn, {0, 0});
  double nearest = shape.outer.front().x;
  for (const host::Point& p : shape.outer) nearest = std::min(nearest, p.x);
  const host::TimedPose place = relative(base, ahead - nearest, left);
  const double height = dice.between(lowest, 0.2);
  return thing("block", random_colour(dice), height, host::moved(shape, place.heading, {place.x, place.y}));
}

Judged run_cell(const Encounter& encounter, const Conditions& conditions) {
  std::vector<record::Setting> settings = encounter.settings;
  settings.insert(settings.end(), conditions.settings.begin(), conditions.settings.end());
  const auto listener = make_listener(conditions.rule, conditions.profile, settings);
  return {encounter, *listener};
}

void drive_towards(Dice& dice, const host::TimedPose& start, double ahead, Encounter& encounter) {
  const double standing = dice.between(0.2, 1);
  const double speed = dice.between(0.1, 0.4);
  encounter.route = Route(start, {{standing, 0, 0}, {1, speed, 0}});
  encounter.seconds = standing + ahead / speed;
}

Outcome meet_nothing(const Encounter& encounter, const Conditions& conditions) {
  Outcome outcome;
  const Judged run = run_cell(encounter, conditions);
  judge_no_stop(run, outcome);
  judge_false_stops(run, outcome);
  outcome.measures.push_back(outcome.false_stops);
  return outcome;
}

}  // namespace fencepost::test
