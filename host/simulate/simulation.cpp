#include "host/simulate/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "firmware/record/encode.hpp"
#include "host/geometry/rings.hpp"
#include "host/simulate/detector.hpp"
#include "host/simulate/random.hpp"

namespace fencepost::host {
namespace {

/// FPCAM and FPSIG come again this often.
constexpr base::Duration kRepeatPeriod = base::milliseconds(10'000);

double true_pitch(const Scene& scene) {
  const auto& pitch = scene.camera.mount.pitch;
  return (pitch ? pitch->to_double() : 0.0) + scene.noise.pitch_error;
}

}  // namespace

Simulation::Simulation(const Scene& scene, Trajectory trajectory, const LineSink& sink, const TruthSink& truth)
    : scene_(scene),
      written_(scene.camera),
      sink_(sink),
      truth_(truth),
      trajectory_(std::move(trajectory)),
      world_(scene),
      odometer_(scene, trajectory_),
      car_(scene, trajectory_),
      rendered_(scene.camera),
      pitch_(true_pitch(scene)),
      rays_(rendered_, pitch_),
      image_(scene.camera.width, scene.camera.height),
      repeat_{kRepeatPeriod.raw} {}

void Simulation::begin() {
  record::Header header;
  header.product = "fencepost";
  header.version = kSimulatorVersion;
  header.target = "simulator";
  header.profile = "full";
  write(header);
  write_calibration();
  list_next_exposure();
}

bool Simulation::step(const std::function<bool(double t)>& ended) {
  // One sample past the last arrival, so every frame is out when the run ends.
  if (!in_range_ || (!next_ && t_ > end_ + kOdometryPeriod)) return false;
  // A frame that arrives together with a sample comes after it: its pose is then already there.
  for (; next_ && next_->arrives < t_; list_next_exposure()) write_frame(*next_);
  if (ended && ended(t_.to_double())) return false;
  if (t_ >= repeat_) {
    write_calibration();
    repeat_ = repeat_ + kRepeatPeriod;
  }
  if (scene_.odometry.of_car()) {
    write(car_.next());
  } else {
    write(odometer_.next());
  }
  ++summary_.odometry;
  summary_.duration = t_.to_double();
  t_ = t_ + kOdometryPeriod;
  return in_range_;
}

bool Simulation::run(const std::function<bool(double t)>& ended) {
  begin();
  while (step(ended)) {
  }
  return in_range_;
}

void Simulation::scene_changed() {
  world_.emplace(scene_);
  const double pitch = true_pitch(scene_);
  if (scene_.camera == rendered_ && pitch == pitch_) return;
  rendered_ = scene_.camera;
  pitch_ = pitch;
  rays_ = PixelRays(rendered_, pitch_);
  image_ = LabelImage(rendered_.width, rendered_.height);
}

void Simulation::list_next_exposure() {
  next_.reset();
  while (!next_ && listed_ < trajectory_.frames()) {
    const int i = listed_++;
    const auto number = static_cast<std::uint64_t>(i);
    if (Random(scene_.seed, Purpose::kDrop, number).chance(scene_.noise.frame_drop_probability)) {
      ++summary_.frames_dropped;
      continue;
    }
    const base::Time exposed = base::Time::nearest(i / scene_.rate);
    const double late = scene_.noise.latency_jitter * Random(scene_.seed, Purpose::kLatency, number).gaussian();
    // Not before its exposure, and not before the frame in front of it.
    base::Time arrives = std::max(exposed, exposed + written_.latency + base::Duration::nearest(late));
    arrives = std::max(arrives, base::Time{previous_.raw + 1});
    previous_ = arrives;
    end_ = std::max({end_, exposed, arrives});
    next_ = Exposure{number, exposed, arrives};
  }
}

template <class Record>
void Simulation::write(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t length = record::encode(record, line);
  in_range_ = in_range_ && length > 0;
  if (length > 0) sink_({line.data(), length});
}

void Simulation::write_calibration() {
  write(written_);
  for (const SceneSignature& signature : scene_.signatures) write(signature.recorded());
  if (scene_.odometry.of_car()) write_car();
}

// The car's numbers, as settings of the robot.
void Simulation::write_car() {
  const auto setting = [&](std::string_view key, double value, int decimals) {
    std::array<char, 32> text{};
    const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    write(record::Setting{sensor::Text(key), std::string_view(text.data(), static_cast<std::size_t>(size))});
  };
  setting("car.counts", scene_.odometry.counts, 1);
  if (scene_.odometry.wheelbase > 0) setting("car.wheelbase", scene_.odometry.wheelbase, 3);
}

void Simulation::write_frame(const Exposure& exposure) {
  const TimedPose robot = trajectory_.at(exposure.exposed.to_double());
  const CameraPose camera = camera_at(robot);
  const std::vector<SceneObject>& objects = world_->at(exposure.exposed.to_double());
  for (const SceneObject& object : objects) {
    const bool level = camera.z >= object.base && camera.z <= object.base + object.height_m;
    if (level && contains(object.footprint, {camera.x, camera.y})) {
      ++summary_.frames_inside;
      break;
    }
  }
  image_.render(objects, rays_, camera);
  FrameTruth truth;
  truth.exposure = exposure.exposed;
  truth.pose = robot;
  truth.frame.t = exposure.arrives;
  truth.frame.frame = static_cast<std::uint32_t>(exposure.number);
  const auto limit = std::min<std::size_t>(static_cast<std::size_t>(scene_.max_blobs), sensor::kMaxBlobs);
  for (const Detection& detection : detect(scene_, image_, exposure.number)) {
    if (truth.blobs.size() < limit && truth.frame.blobs.push_back(detection.blob)) {
      truth.blobs.push_back(detection.truth);
      ++summary_.blobs;
    } else {
      ++summary_.blobs_dropped;
    }
  }
  write(truth.frame);
  ++summary_.frames;
  if (truth_) truth_(truth);
}

CameraPose Simulation::camera_at(const TimedPose& robot) const {
  const sensor::CameraMount& mount = scene_.camera.mount;
  const double c = std::cos(robot.heading);
  const double s = std::sin(robot.heading);
  const double x = mount.x.to_double();
  const double y = mount.y.to_double();
  return {robot.x + c * x - s * y, robot.y + s * x + c * y, mount.z.to_double(),
          robot.heading + mount.yaw.to_double() + scene_.noise.yaw_error};
}

}  // namespace fencepost::host
