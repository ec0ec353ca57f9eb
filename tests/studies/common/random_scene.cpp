#include "tests/studies/common/random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"
#include "tests/studies/common/random_footprint.hpp"

namespace fencepost::test {
namespace {

struct Disc {
  host::Point center;
  double radius;
};

void set_noise(host::Scene& scene, int level) {
  if (level == 0) return;
  scene.noise.edge_px = level == 1 ? 1.0 : 1.5;
  scene.noise.pose_xy = level == 1 ? 0.002 : 0.005;
  scene.noise.pose_heading = (level == 1 ? 0.2 : 0.5) * std::numbers::pi / 180;
  if (level == 1) return;
  scene.noise.loss_probability = 0.05;
  scene.noise.growth_probability = 0.02;
  scene.noise.miss_probability = 0.02;
}

}  // namespace

host::Scene random_scene(unsigned seed, int objects, Colours colours, int noise) {
  Dice dice(seed);
  host::Scene scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  scene.rate = 10;
  set_noise(scene, noise);
  std::vector<Disc> placed;
  for (int tries = 0; static_cast<int>(placed.size()) < objects && tries < 5000; ++tries) {
    const host::LinearRing ring = random_footprint(dice);
    const double angle = dice.between(0, 2 * std::numbers::pi);
    const double away = 0.35 * std::sqrt(dice.between(0, 1));
    const Disc disc{{away * std::cos(angle), away * std::sin(angle)}, radius_of(ring)};
    const bool free = std::none_of(placed.begin(), placed.end(), [&](const Disc& other) {
      return std::hypot(other.center.x - disc.center.x, other.center.y - disc.center.y) <
             other.radius + disc.radius + 0.03;
    });
    if (!free) continue;
    placed.push_back(disc);
    host::SceneObject object;
    object.name = "object " + std::to_string(placed.size());
    object.signature = colours == Colours::kAllTheSame ? 1 : static_cast<std::uint8_t>(placed.size());
    object.height_m = dice.between(0.05, 0.2);
    object.footprint = host::moved({ring, {}}, dice.between(0, 2 * std::numbers::pi), disc.center);
    if (colours == Colours::kAllDifferent || placed.size() == 1) {
      scene.signatures.push_back({object.signature, "colour " + std::to_string(object.signature), {200, 40, 40}});
    }
    scene.objects.push_back(object);
  }
  host::ArcPath arc;
  arc.radius = dice.between(0.8, 1.1);
  arc.start = dice.between(0, 6);
  arc.sweep = 2 * std::numbers::pi * 74 / 75;
  arc.views = 75;
  scene.path = arc;
  return scene;
}

}  // namespace fencepost::test
