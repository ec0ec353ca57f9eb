#include "host/simulate/simulate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/record/encode.hpp"
#include "host/geometry/rings.hpp"
#include "host/simulate/car_odometer.hpp"
#include "host/simulate/detector.hpp"
#include "host/simulate/odometer.hpp"
#include "host/simulate/random.hpp"
#include "host/simulate/trajectory.hpp"
#include "host/simulate/truth.hpp"
#include "host/simulate/world.hpp"

namespace fencepost::host {

namespace {

/// FPCAM and FPSIG come again this often.
constexpr base::Duration kRepeatPeriod = base::milliseconds(10'000);

using TruthSink = std::function<void(const FrameTruth&)>;

struct Exposure {
  std::uint64_t number = 0;
  base::Time exposed;
  base::Time arrives;
};

/// One run of one scene.
class Simulation {
 public:
  Simulation(const Scene& scene, Trajectory trajectory, const LineSink& sink, const TruthSink& truth)
      : scene_(scene),
        sink_(sink),
        truth_(truth),
        trajectory_(std::move(trajectory)),
        world_(scene),
        odometer_(scene, trajectory_),
        car_(scene, trajectory_),
        rays_(scene.camera, true_pitch(scene)),
        image_(scene.camera.width, scene.camera.height) {}

  /// Up to the end of the path, or until `ended` says so. False: a value was outside the range of its record.
  bool run(const std::function<bool(double t)>& ended = {}) {
    record::Header header;
    header.product = "fencepost";
    header.version = kSimulatorVersion;
    header.target = "simulator";
    header.profile = "full";
    write(header);
    write_calibration();
    const std::vector<Exposure> exposures = list_exposures();
    base::Time end{0};
    for (const Exposure& exposure : exposures) end = std::max({end, exposure.exposed, exposure.arrives});
    base::Time repeat{kRepeatPeriod.raw};
    std::size_t next = 0;
    // One sample past the last arrival, so every frame is out when the loop ends.
    for (base::Time t{0}; t <= end + kOdometryPeriod && in_range_; t = t + kOdometryPeriod) {
      // A frame that arrives together with a sample comes after it: its pose is then already there.
      for (; next < exposures.size() && exposures[next].arrives < t; ++next) write_frame(exposures[next]);
      if (ended && ended(t.to_double())) break;
      if (t >= repeat) {
        write_calibration();
        repeat = repeat + kRepeatPeriod;
      }
      if (scene_.odometry.of_car()) {
        write(car_.next());
      } else {
        write(odometer_.next());
      }
      ++summary_.odometry;
      summary_.duration = t.to_double();
    }
    return in_range_;
  }

  [[nodiscard]] const SimulationSummary& summary() const { return summary_; }

 private:
  static double true_pitch(const Scene& scene) {
    const auto& pitch = scene.camera.mount.pitch;
    return (pitch ? pitch->to_double() : 0.0) + scene.noise.pitch_error;
  }

  std::vector<Exposure> list_exposures() {
    std::vector<Exposure> exposures;
    base::Time previous{-1};
    for (int i = 0; i < trajectory_.frames(); ++i) {
      const auto number = static_cast<std::uint64_t>(i);
      if (Random(scene_.seed, Purpose::kDrop, number).chance(scene_.noise.frame_drop_probability)) {
        ++summary_.frames_dropped;
        continue;
      }
      const base::Time exposed = base::Time::nearest(i / scene_.rate);
      const double late = scene_.noise.latency_jitter * Random(scene_.seed, Purpose::kLatency, number).gaussian();
      // Not before its exposure, and not before the frame in front of it.
      base::Time arrives = std::max(exposed, exposed + scene_.camera.latency + base::Duration::nearest(late));
      arrives = std::max(arrives, base::Time{previous.raw + 1});
      previous = arrives;
      exposures.push_back({number, exposed, arrives});
    }
    return exposures;
  }

  template <class Record>
  void write(const Record& record) {
    std::array<char, record::kMaxLine> line{};
    const std::size_t length = record::encode(record, line);
    in_range_ = in_range_ && length > 0;
    if (length > 0) sink_({line.data(), length});
  }

  void write_calibration() {
    write(scene_.camera);
    for (const SceneSignature& signature : scene_.signatures) {
      write(record::Signature{signature.id, signature.rgb, sensor::Text(signature.name), signature.width});
    }
    if (scene_.odometry.of_car()) write_car();
  }

  // What the robot's settings would say of it.
  void write_car() {
    const auto setting = [&](std::string_view key, double value, int decimals) {
      std::array<char, 32> text{};
      const int size = std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
      write(record::Setting{sensor::Text(key), std::string_view(text.data(), static_cast<std::size_t>(size))});
    };
    setting("car.counts", scene_.odometry.counts, 1);
    if (scene_.odometry.wheelbase > 0) setting("car.wheelbase", scene_.odometry.wheelbase, 3);
  }

  void write_frame(const Exposure& exposure) {
    const TimedPose robot = trajectory_.at(exposure.exposed.to_double());
    const CameraPose camera = camera_at(robot);
    const std::vector<SceneObject>& objects = world_.at(exposure.exposed.to_double());
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

  [[nodiscard]] CameraPose camera_at(const TimedPose& robot) const {
    const sensor::CameraMount& mount = scene_.camera.mount;
    const double c = std::cos(robot.heading);
    const double s = std::sin(robot.heading);
    const double x = mount.x.to_double();
    const double y = mount.y.to_double();
    return {robot.x + c * x - s * y, robot.y + s * x + c * y, mount.z.to_double(),
            robot.heading + mount.yaw.to_double() + scene_.noise.yaw_error};
  }

  const Scene& scene_;
  const LineSink& sink_;
  const TruthSink& truth_;
  Trajectory trajectory_;
  World world_;
  Odometer odometer_;
  CarOdometer car_;
  PixelRays rays_;
  LabelImage image_;
  SimulationSummary summary_;
  bool in_range_ = true;
};

/// What every pixel costs memory and time for; photographs have the same limit.
constexpr std::uint64_t kMostPixels = 64U << 20U;

std::string too_large(const sensor::CameraIntrinsics& camera) {
  return "an image of " + std::to_string(camera.width) + " x " + std::to_string(camera.height) +
         " pixels is too large to be rendered, more than 64 megapixels; give the camera's own \"width\" and \"height\"";
}

bool can_be_rendered(const sensor::CameraIntrinsics& camera) {
  return std::uint64_t{camera.width} * camera.height <= kMostPixels;
}

std::string out_of_range() {
  return "a value is outside the range of its record (positions +-1000 m, headings +-1000 rad, t up to 999999 s); "
         "shorten the path or move it nearer to the origin";
}

}  // namespace

base::Result<SimulationSummary, std::string> simulate(const Scene& scene, const LineSink& sink) {
  return simulate_with_truth(scene, sink, {});
}

base::Result<SimulationSummary, std::string> simulate_with_truth(const Scene& scene, const LineSink& sink,
                                                                 const TruthSink& truth) {
  if (std::holds_alternative<std::monostate>(scene.path)) {
    return std::string("the scene has no path to drive; add \"path\" (arc, waypoints or poses)");
  }
  if (!can_be_rendered(scene.camera)) return too_large(scene.camera);
  Simulation simulation(scene, Trajectory(scene), sink, truth);
  if (!simulation.run()) return out_of_range();
  return simulation.summary();
}

base::Result<SimulationSummary, std::string> simulate_driven(const Scene& scene, const Driven& driven,
                                                             const LineSink& sink, const TruthSink& truth) {
  if (!can_be_rendered(scene.camera)) return too_large(scene.camera);
  Simulation simulation(scene, Trajectory(scene, driven.pose, driven.duration), sink, truth);
  if (!simulation.run(driven.ended)) return out_of_range();
  return simulation.summary();
}

}  // namespace fencepost::host
