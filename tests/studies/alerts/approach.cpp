#include "tests/studies/alerts/approach.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"
#include "tests/studies/common/random_footprint.hpp"

namespace fencepost::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kStep = 0.02;       // s, between poses of the path
constexpr double kTouching = 0.105;  // m, where a run ends: the body is 0.1 m wide on either side
constexpr double kGap = 0.03;        // m, between blocks
constexpr int kColours = 4;

Drive random_drive(Dice& dice) {
  Drive drive;
  drive.start = {0, dice.between(-5, 5), dice.between(-5, 5), dice.between(-kPi, kPi)};
  drive.standing = dice.below(2) == 0 ? 0 : dice.between(0.2, 1);
  drive.speed = dice.between(0.08, 0.4);
  const bool straight = dice.below(3) == 0;
  const double curvature = dice.between(-1.25, 1.25);
  drive.curvature = straight ? 0 : curvature;
  return drive;
}

struct Place {
  host::Point center;
  double heading = 0;
};

// So far along the way, so far to its left.
Place beside(const Drive& drive, double along, double left) {
  const host::TimedPose pose = drive.at(drive.time_of(along));
  return {{pose.x - left * std::sin(pose.heading), pose.y + left * std::cos(pose.heading)}, pose.heading};
}

class Blocks {
 public:
  Blocks(Dice& dice, const Drive& drive, double nearest, host::Scene& scene)
      : dice_(dice), drive_(drive), nearest_(nearest), scene_(scene) {}

  /// Tries a few places; a crowded scene goes without.
  void add(double along_from, double along_to, double aside) {
    for (int tries = 0; tries < 20; ++tries) {
      const host::LinearRing ring = random_footprint(dice_);
      const Place place = beside(drive_, dice_.between(along_from, along_to), dice_.between(-aside, aside));
      const host::Polygon footprint = host::moved({ring, {}}, dice_.between(0, 2 * kPi), place.center);
      const double height = dice_.between(0.05, 0.2);
      const auto colour = static_cast<std::uint8_t>(1 + dice_.below(kColours));
      if (distance_to(footprint, {drive_.start.x, drive_.start.y}) < nearest_) continue;
      if (!free(place.center, radius_of(ring))) continue;
      centers_.push_back(place.center);
      radii_.push_back(radius_of(ring));
      host::SceneObject object;
      object.name = "block " + std::to_string(centers_.size());
      object.signature = colour;
      object.height_m = height;
      object.footprint = footprint;
      scene_.objects.push_back(object);
      return;
    }
  }

 private:
  [[nodiscard]] bool free(host::Point center, double radius) const {
    for (std::size_t i = 0; i < centers_.size(); ++i) {
      const double apart = std::hypot(centers_[i].x - center.x, centers_[i].y - center.y);
      if (apart < radii_[i] + radius + kGap) return false;
    }
    return true;
  }

  Dice& dice_;
  const Drive& drive_;
  double nearest_;
  host::Scene& scene_;
  std::vector<host::Point> centers_;
  std::vector<double> radii_;
};

double end_of(const Drive& drive, const host::Scene& scene, double way) {
  double t = 0;
  for (; t < drive.time_of(way); t += kStep) {
    const host::TimedPose pose = drive.at(t);
    for (const host::SceneObject& object : scene.objects) {
      if (distance_to(object.footprint, {pose.x, pose.y}) < kTouching) return t;
    }
  }
  return t;
}

}  // namespace

host::TimedPose Drive::at(double t) const {
  const double way = speed * std::max(0.0, t - standing);
  const double heading = start.heading + curvature * way;
  if (curvature == 0) return {t, start.x + way * std::cos(heading), start.y + way * std::sin(heading), heading};
  return {t, start.x + (std::sin(heading) - std::sin(start.heading)) / curvature,
          start.y - (std::cos(heading) - std::cos(start.heading)) / curvature, heading};
}

Approach random_approach(unsigned seed, const NoiseLevel& level, double nearest) {
  Dice dice(seed);
  Approach approach;
  host::Scene& scene = approach.scene;
  scene.seed = seed;
  scene.camera = host::table_camera("test");
  scene.rate = 10;
  scene.camera.latency = base::Duration::nearest(0.05);
  scene.noise = scene_noise(level);
  for (std::uint8_t id = 1; id <= kColours; ++id) scene.signatures.push_back({id, "colour " + std::to_string(id), {}});
  approach.drive = random_drive(dice);
  Blocks blocks(dice, approach.drive, nearest, scene);
  const double way = dice.between(nearest + 0.2, 2.2);
  if (dice.below(5) != 0) blocks.add(nearest, way, 0.15);
  const unsigned others = 1 + dice.below(5);
  for (unsigned i = 0; i < others; ++i) blocks.add(0, way + 0.5, 0.8);
  approach.end = end_of(approach.drive, scene, way);
  host::PosesPath path;
  for (double t = 0; t <= approach.end; t += kStep) path.poses.push_back(approach.drive.at(t));
  scene.path = path;
  return approach;
}

double distance_to(const host::Polygon& footprint, host::Point place) {
  if (host::contains(footprint, place)) return 0;
  return host::distance_to_outline(place, footprint.outer);
}

}  // namespace fencepost::test
