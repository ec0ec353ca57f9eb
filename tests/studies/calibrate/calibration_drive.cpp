#include "tests/studies/calibrate/calibration_drive.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/geometry/rings.hpp"
#include "host/simulate/random.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/common/random_footprint.hpp"

namespace fencepost::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kStep = 0.02;  // s

/// Drives by speeds that a robot can have: they change within some tenths of a second.
class Driver {
 public:
  void go(double speed, double turn_rate, double seconds) {
    constexpr double kRamp = 0.15;  // s, time constant
    for (double t = 0; t < seconds; t += kStep) {
      speed_ += (speed - speed_) * kStep / kRamp;
      turn_rate_ += (turn_rate - turn_rate_) * kStep / kRamp;
      host::TimedPose next = poses_.back();
      next.t += kStep;
      next.heading += turn_rate_ * kStep;
      next.x += speed_ * kStep * std::cos(next.heading);
      next.y += speed_ * kStep * std::sin(next.heading);
      poses_.push_back(next);
    }
  }
  [[nodiscard]] const std::vector<host::TimedPose>& poses() const { return poses_; }

 private:
  std::vector<host::TimedPose> poses_{{0, 0, 0, 0}};
  double speed_ = 0;
  double turn_rate_ = 0;
};

/// Half around to one side, then to the other, so that both latency and the whole turn show.
std::vector<host::TimedPose> to_and_fro(int straights, double speed, double rate, double length) {
  Driver driver;
  driver.go(0, 0, 0.5);
  for (int i = 0; i < straights; ++i) {
    driver.go(speed, 0, length / speed);
    driver.go(0, 0, 0.3);
    driver.go(0, i % 4 < 2 ? rate : -rate, std::numbers::pi / std::abs(rate));
    driver.go(0, 0, 0.3);
  }
  return driver.poses();
}

std::vector<host::TimedPose> way_of(const DriveOptions& options, Dice& dice) {
  const Motion motion = options.motion;
  Driver driver;
  const double speed = dice.between(0.17, 0.23);
  const double rate = dice.between(0.75, 0.9) * (dice.below(2) == 0 ? 1 : -1);
  const double straight = dice.between(1.2, 1.4) / speed;
  const double around = (2 * std::numbers::pi + dice.between(0, 0.4)) / std::abs(rate);
  if (motion == Motion::kToAndFro) return to_and_fro(options.straights, speed, rate, straight * speed);
  driver.go(0, 0, 0.5);
  if (motion == Motion::kStanding) driver.go(0, 0, 15);
  if (motion != Motion::kSpin && motion != Motion::kStanding) driver.go(speed, 0, straight);
  if (motion == Motion::kStraight || motion == Motion::kStanding) return driver.poses();
  driver.go(0, 0, 0.3);
  driver.go(0, rate, around);
  if (motion == Motion::kSpin) return driver.poses();
  const double bend = dice.between(0.4, 0.6);
  driver.go(0, 0, 0.3);
  driver.go(speed, bend, 1.2);
  driver.go(speed, -bend, 2);
  driver.go(speed, bend, 0.8);
  driver.go(0, 0, 0.5);
  return driver.poses();
}

double clearance(const std::vector<host::TimedPose>& way, host::Point p) {
  double least = 1e9;
  for (const host::TimedPose& pose : way) least = std::min(least, std::hypot(p.x - pose.x, p.y - pose.y));
  return least;
}

/// Around the place where the robot turns, one to each side and one straight ahead, out of its way.
/// Or, where it goes to and fro, a near and a far one beyond either end.
host::Point place_of_block(int i, bool to_and_fro, Dice& dice) {
  static constexpr std::array<double, 6> kAround = {0.7, -0.3, 2.4, -2.2, 1.5, -1.3};
  static constexpr std::array<double, 6> kBeyond = {0.35, -0.2, 2.8, -2.94, 1.5, -1.3};
  const bool far = i == 1 || (to_and_fro && i == 3);
  const bool behind = to_and_fro && (i == 2 || i == 3);
  const double spread = to_and_fro ? 0.15 : 0.35;
  const double angle = (to_and_fro ? kBeyond : kAround)[static_cast<std::size_t>(i)] + dice.between(-spread, spread);
  const double range = far ? dice.between(1.3, 1.7) : dice.between(0.5, 0.9);
  return {(behind ? 0 : 1.3) + range * std::cos(angle), range * std::sin(angle)};
}

void place_blocks(host::Scene& scene, const std::vector<host::TimedPose>& way, const DriveOptions& options,
                  Dice& dice) {
  static const std::array<const char*, 6> kNames = {"red", "green", "blue", "yellow", "orange", "pink"};
  static const std::array<sensor::Rgb, 6> kColours = {
      {{208, 32, 32}, {32, 160, 48}, {32, 64, 208}, {216, 192, 32}, {224, 120, 24}, {224, 96, 160}}};
  // As the guide has it: a near one and a far one ahead, the others around where it turns.
  for (int i = 0; i < options.blocks; ++i) {
    const auto id = static_cast<std::uint8_t>(i + 1);
    host::LinearRing ring = random_footprint(dice);
    const double scale = dice.between(0.05, 0.10) / (2 * radius_of(ring));
    for (host::Point& p : ring) p = {scale * p.x, scale * p.y};
    const double radius = radius_of(ring);
    host::Point at;
    for (int attempt = 0; attempt == 0 || clearance(way, at) < radius + 0.15; ++attempt) {
      if (attempt > 2000) throw std::runtime_error("no room for a block");
      at = place_of_block(i, options.motion == Motion::kToAndFro, dice);
    }
    const double turn = dice.between(0, 6.28);
    host::Polygon footprint{ring, {}};
    footprint = host::moved(footprint, turn, {at.x, at.y});
    host::SceneObject object;
    object.name = kNames[static_cast<std::size_t>(i)];
    object.signature = id;
    object.height_m = dice.between(0.06, 0.25);
    object.footprint = footprint;
    scene.objects.push_back(object);
    scene.signatures.push_back({id, object.name, kColours[static_cast<std::size_t>(i)]});
  }
}

double sign(Dice& dice) { return dice.below(2) == 0 ? 1 : -1; }

/// A Pixy2 that was screwed on by hand.
sensor::CameraIntrinsics true_camera(double fisheye, Dice& dice) {
  sensor::CameraIntrinsics camera;
  camera.model = "pixy2";
  camera.width = 316;
  camera.height = 208;
  const double nominal = fisheye > 0 ? camera.width / (fisheye * kDegree) : 273.6;
  if (fisheye > 0) camera.lens = sensor::Lens::kEquidistant;
  const double f = nominal * dice.between(0.95, 1.05);
  camera.fx = camera.fy = base::Pixels2::nearest(f);
  camera.cx = base::Pixels2::nearest(157.5);
  camera.cy = base::Pixels2::nearest(103.5);
  camera.mount.x = base::Metres::nearest(dice.between(0.02, 0.08));
  camera.mount.y = base::Metres::nearest(dice.between(-0.02, 0.02));
  camera.mount.z = base::Metres::nearest(dice.between(0.11, 0.17));
  camera.mount.yaw = base::Radians::nearest(dice.between(-3, 3) * kDegree);
  camera.mount.pitch = base::Radians::nearest(dice.between(0, 6) * kDegree);
  camera.latency = base::Duration::nearest(dice.between(0.05, 0.10));
  return camera;
}

sensor::CameraIntrinsics configured_camera(const sensor::CameraIntrinsics& truth, Dice& dice) {
  sensor::CameraIntrinsics configured = truth;
  const auto millimetres = [&] { return dice.between(-0.004, 0.004); };
  configured.fx = configured.fy = base::Pixels2::nearest(truth.fx.to_double() / (1 + 0.05 * sign(dice)));
  configured.mount.yaw = base::Radians::nearest(truth.mount.yaw.to_double() + 2 * kDegree * sign(dice));
  configured.mount.pitch = base::Radians::nearest(truth.mount.pitch->to_double() + 2 * kDegree * sign(dice));
  configured.latency = base::Duration::nearest(truth.latency.to_double() + 0.05 * sign(dice));
  configured.mount.x = base::Metres::nearest(truth.mount.x.to_double() + millimetres());
  configured.mount.y = base::Metres::nearest(truth.mount.y.to_double() + millimetres());
  configured.mount.z = base::Metres::nearest(truth.mount.z.to_double() + millimetres());
  return configured;
}

host::SceneNoise noise_of(const DriveOptions& options) {
  host::SceneNoise noise = scene_noise(noise_levels()[1]);
  noise.edge_px *= options.noise;
  noise.edge_bias_px = options.pad;
  noise.pose_xy *= options.noise;
  noise.pose_heading *= options.noise;
  host::Random random(options.seed, host::Purpose::kDrift, 77);
  noise.drift_scale = options.drift * 0.01 * random.gaussian();
  noise.drift_turn = options.drift * 1 * kDegree * random.gaussian();
  noise.drift_walk = options.drift * 0.003;
  return noise;
}

}  // namespace

CalibrationDrive calibration_drive(const DriveOptions& options) {
  Dice dice(options.seed);
  CalibrationDrive drive;
  drive.scene.seed = options.seed;
  drive.scene.rate = 50;
  drive.scene.camera = true_camera(options.fisheye, dice);
  drive.configured = configured_camera(drive.scene.camera, dice);
  const std::vector<host::TimedPose> way = way_of(options, dice);
  drive.scene.path = host::PosesPath{way};
  place_blocks(drive.scene, way, options, dice);
  drive.scene.noise = noise_of(options);
  const auto simulated = host::simulate(drive.scene, [&](std::string_view line) {
    drive.log += line.starts_with("$FPCAM") ? line_of(drive.configured) : std::string(line);
  });
  if (!simulated) throw std::runtime_error(simulated.error());
  return drive;
}

double true_value(const CalibrationDrive& drive, std::string_view key) {
  const sensor::CameraIntrinsics& camera = drive.scene.camera;
  const double metre = 1 + drive.scene.noise.drift_scale;  // the odometry's
  if (key == "focal_length") return camera.fx.to_double();
  if (key == "yaw") return camera.mount.yaw.to_double() / kDegree;
  if (key == "pitch") return camera.mount.pitch->to_double() / kDegree;
  if (key == "latency") return 1000 * camera.latency.to_double();
  if (key == "mount_z") return 1000 * camera.mount.z.to_double() * metre;
  if (key == "mount_x") return 1000 * camera.mount.x.to_double() * metre;
  if (key == "mount_y") return 1000 * camera.mount.y.to_double() * metre;
  if (key == "wheel_scale") return 100 * (1 / metre - 1);
  if (key == "curve") return -drive.scene.noise.drift_turn / kDegree / metre;
  return 0;  // lens and turns are true
}

}  // namespace fencepost::test
