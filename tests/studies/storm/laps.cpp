#include "tests/studies/storm/laps.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "host/geometry/rings.hpp"
#include "tests/studies/common/random_footprint.hpp"

namespace fencepost::test {
namespace {

constexpr double kSampling = 0.1;  // s
constexpr double kTurn = 2 * std::numbers::pi;
constexpr base::Duration kSamplePeriod = base::milliseconds(20);

/// Poses along a way, in steps of time.
class Way {
 public:
  void stand(double seconds) {
    for (double left = seconds; left > 0; left -= kSampling) step(0, 0);
  }
  /// Speeds up and slows down within a tenth of it.
  void go(double distance, double turn, double seconds) {
    const auto steps = static_cast<int>(std::ceil(seconds / kSampling));
    double done = 0;
    for (int i = 1; i <= steps; ++i) {
      const double share = eased(static_cast<double>(i) / steps);
      step((share - done) * distance, (share - done) * turn);
      done = share;
    }
  }
  [[nodiscard]] const std::vector<host::TimedPose>& poses() const { return poses_; }

 private:
  static double eased(double x) {
    constexpr double kRamp = 0.1;
    constexpr double kTop = 1 / (1 - kRamp);
    if (x < kRamp) return kTop * x * x / (2 * kRamp);
    if (x > 1 - kRamp) return 1 - kTop * (1 - x) * (1 - x) / (2 * kRamp);
    return kTop * (x - kRamp / 2);
  }
  void step(double distance, double turn) {
    const double middle = heading_ + turn / 2;
    const double chord = std::abs(turn) < 1e-9 ? distance : distance * std::sin(turn / 2) / (turn / 2);
    x_ += chord * std::cos(middle);
    y_ += chord * std::sin(middle);
    heading_ += turn;
    t_ += kSampling;
    poses_.push_back({t_, x_, y_, std::remainder(heading_, kTurn)});
  }

  double t_ = 0;
  double x_ = 0;
  double y_ = 0;
  double heading_ = 0;
  std::vector<host::TimedPose> poses_{{0, 0, 0, 0}};
};

struct Place {
  host::Point center;
  double free = 0;  ///< m, to the way
};

void put_object(Chance& chance, const LapChoice& choice, const Place& place, host::Scene& scene) {
  Dice dice(static_cast<unsigned>(chance.whole(1, 1'000'000'000)));
  host::SceneObject object;
  object.name = "object " + std::to_string(scene.objects.size() + 1);
  object.signature = chance.of(choice.signatures).signature;
  object.height_m = chance.real(0.08, 0.3);
  object.footprint = host::moved({random_footprint(dice), {}}, chance.real(0, kTurn), place.center);
  scene.objects.push_back(object);
}

// As near as it may come to any place of the way.
bool is_free(const host::Scene& scene, const std::vector<host::TimedPose>& way, std::size_t object, double least) {
  const host::Polygon& footprint = scene.objects[object].footprint;
  for (const host::TimedPose& pose : way) {
    const host::Point here{pose.x, pose.y};
    if (host::contains(footprint, here) || host::distance_to_outline(here, footprint.outer) < least) return false;
  }
  return true;
}

Way random_way(Chance& chance) {
  Way way;
  way.stand(chance.real(0.5, 2));
  const double speed = chance.real(0.08, 0.5);
  switch (chance.whole(0, 3)) {
    case 0: {
      const double radius = chance.real(0.5, 1.2);
      way.go(kTurn * radius, chance.one_in(2) ? kTurn : -kTurn, kTurn * radius / speed);
      break;
    }
    case 1: way.go(0, chance.one_in(2) ? kTurn : -kTurn, chance.real(6, 20)); break;
    default: {
      const double distance = chance.real(0.5, 2.5);
      way.go(distance, 0, distance / speed);
      way.stand(chance.real(0.5, 3));
      way.go(-distance, 0, distance / speed);
      break;
    }
  }
  way.stand(chance.real(0.2, 1));
  return way;
}

void set_noise(Chance& chance, host::Scene& scene) {
  scene.noise.edge_px = chance.one_in(3) ? 0 : chance.real(0, 1.5);
  if (chance.one_in(2)) return;
  scene.noise.miss_probability = chance.real(0, 0.1);
  scene.noise.loss_probability = chance.real(0, 0.1);
  scene.noise.false_rate = chance.one_in(3) ? chance.real(0, 0.2) : 0;
  scene.noise.latency_jitter = chance.one_in(3) ? chance.real(0, 0.01) : 0;
  scene.noise.frame_drop_probability = chance.one_in(3) ? chance.real(0, 0.05) : 0;
}

}  // namespace

Lap::Lap(const host::Scene& scene) : feed(emulate::feed_from_scene(scene)), travel(feed.poses) {
  if (!feed.problem.empty()) throw std::runtime_error(feed.problem);
  length = feed.end() - feed.begin() + kSamplePeriod;
}

host::Scene random_lap(Chance& chance, const LapChoice& choice) {
  host::Scene scene;
  scene.seed = static_cast<std::uint64_t>(chance.whole(1, 1'000'000'000));
  scene.camera = choice.camera;
  scene.rate = choice.rate;
  for (const record::Signature& known : choice.signatures) {
    scene.signatures.push_back({known.signature, std::string(known.name.view()), known.rgb});
  }
  set_noise(chance, scene);
  const Way way = random_way(chance);
  scene.path = host::PosesPath{way.poses()};
  const host::TimedPose& farthest = way.poses()[way.poses().size() / 2];
  const std::int64_t count = chance.whole(0, 6);
  for (int tries = 0; tries < 60 && static_cast<std::int64_t>(scene.objects.size()) < count; ++tries) {
    const bool ahead = scene.objects.empty() && chance.one_in(2);
    const Place place = ahead ? Place{{farthest.x + chance.real(0.15, 0.5), farthest.y + chance.real(-0.1, 0.1)}, 0.12}
                              : Place{{chance.real(-1.5, 3.5), chance.real(-2, 2)}, 0.18};
    put_object(chance, choice, place, scene);
    if (!is_free(scene, way.poses(), scene.objects.size() - 1, place.free)) scene.objects.pop_back();
  }
  return scene;
}

}  // namespace fencepost::test
