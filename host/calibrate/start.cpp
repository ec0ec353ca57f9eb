#include "host/calibrate/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "host/calibrate/sighting_model.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kMinObjects = 2;  ///< one alone is as well larger and farther away
constexpr double kMinDriven = 0.10;     ///< m, or
constexpr double kMinTurned = 0.35;     ///< rad: less than this is no motion
// A frame that was taken where the last one was says the same again.
constexpr double kStepWay = 0.002;   ///< m
constexpr double kStepTurn = 0.002;  ///< rad
constexpr double kStepTime = 0.5;    ///< s
constexpr double kNodeTime = 0.25;   ///< s, at least; within it odometry strays by less than a pixel

// Standard deviations of the priors around the configured values, wide enough to leave to the log what it determines.
constexpr CameraValues kCameraSigma = {0.15, 0.12, 0.12, 0.10, 0.005, 0.004, 0.004, 0.02};  // by CameraParameter
constexpr WheelValues kWheelSigma = {0.05, 0.02, 0.02};                                     // by WheelParameter

std::optional<std::string> why_hopeless(const DriveLog& log, const OdometryTrack& odometry) {
  if (odometry.driven() < kMinDriven && odometry.turned() < kMinTurned) {
    return fmt::format("the robot hardly moves ({:.2f} m, {:.0f} degrees in {:.0f} s); {}", odometry.driven(),
                       odometry.turned() * 57.29577951308232, odometry.end() - odometry.begin(), kGuide);
  }
  if (log.ends > 0 && log.ends == log.ends_cut) {
    return fmt::format(
        "every blob is cut off by the image's border or by another one; put the blocks farther away "
        "and apart, then {}",
        kGuide);
  }
  return std::nullopt;
}

std::vector<SeenFrame> frames_that_count(const DriveLog& log, const OdometryTrack& odometry, double latency,
                                         const StartOptions& options) {
  std::vector<SeenFrame> kept;
  TrackPose last;
  for (const SeenFrame& frame : log.frames) {
    if (frame.boxes.empty() && !options.spare) continue;
    const TrackPose now = odometry.at(frame.t - latency);
    const bool new_view = std::abs(now.way - last.way) > kStepWay || std::abs(now.heading - last.heading) > kStepTurn;
    if (!kept.empty() && !new_view && frame.t - kept.back().t < kStepTime) continue;
    kept.push_back(frame);
    last = now;
  }
  const std::size_t most = options.most_frames;
  if (kept.size() <= most) return kept;
  std::vector<SeenFrame> thinned;
  for (std::size_t i = 0; i < most; ++i) thinned.push_back(kept[i * kept.size() / most]);
  return thinned;
}

std::vector<double> node_times(const std::vector<SeenFrame>& frames, const OdometryTrack& odometry, double latency,
                               double most) {
  const double least = std::max(kNodeTime, (odometry.end() - odometry.begin()) / most);
  std::vector<double> times;
  for (const SeenFrame& frame : frames) {
    const double exposure = frame.t - latency;
    if (times.empty() || exposure >= times.back() + least) times.push_back(exposure);
  }
  return times;
}

Sighting sighting_of(const SeenBox& box, double t, std::size_t object, std::size_t node) {
  Sighting sighting;
  sighting.object = object;
  sighting.node = node;
  sighting.t = t;
  sighting.left = box.left;
  sighting.right = box.right;
  sighting.foot = box.foot;
  sighting.top = box.top;
  sighting.row_low = box.row_low;
  sighting.row_high = box.row_high;
  sighting.middle = box.middle;
  return sighting;
}

void add_sightings(const std::vector<SeenFrame>& frames, double latency, const StartOptions& options,
                   StartedProblem& started) {
  std::map<std::uint32_t, std::size_t> views;
  for (const SeenFrame& frame : frames) {
    for (const SeenBox& box : frame.boxes) views[box.object] += box.left || box.right ? 1U : 0U;
  }
  std::map<std::uint32_t, std::size_t> index;
  const std::vector<double>& nodes = started.problem.node_times;
  for (const SeenFrame& frame : frames) {
    const auto next = std::upper_bound(nodes.begin(), nodes.end(), frame.t - latency + 1e-9);
    const auto node = static_cast<std::size_t>(next - nodes.begin()) - 1;
    for (const SeenBox& box : frame.boxes) {
      if (views[box.object] < options.least_views) {
        if (options.spare) started.spare.push_back({sighting_of(box, frame.t, 0, node), box.signature});
        continue;
      }
      const auto [place, is_new] = index.emplace(box.object, index.size());
      if (is_new) {
        started.signatures.push_back(box.signature);
        started.ids.push_back(box.object);
      }
      started.problem.sightings.push_back(sighting_of(box, frame.t, place->second, node));
    }
    if (!options.spare) continue;
    for (const SeenBox& box : frame.others) {
      started.spare.push_back({sighting_of(box, frame.t, 0, node), box.signature});
    }
  }
}

/// Where the bearings of its middles meet best, and the radius that its boxes have there.
ObjectValues first_guess(const StartedProblem& started, std::size_t object) {
  const CalibrationProblem& problem = started.problem;
  double a[3] = {};  // normal equations of the lines' distances
  double b[2] = {};
  const auto view_of = [&](const Sighting& sighting) {
    const auto robot = calibration::pose_at_exposure<double>(
        problem.odometry, problem.node_times[sighting.node], sighting.t, started.estimate.camera[kLatency],
        started.estimate.wheels.data(), started.estimate.nodes[sighting.node].data());
    return calibration::view_of<double>(problem.optics, started.estimate.camera.data(), robot);
  };
  const auto ray_of = [&](const Sighting& sighting, double row) {
    return calibration::ground_ray(problem.optics, started.estimate.camera, sighting.middle, row);
  };
  constexpr double kUsual = 0.7;    // m, where bearings are parallel
  constexpr double kPrior = 0.002;  // its weight beside a line's
  for (const Sighting& sighting : problem.sightings) {
    if (sighting.object != object) continue;
    const auto view = view_of(sighting);
    const auto ray = ray_of(sighting, 0.5 * (sighting.row_low + sighting.row_high));
    const double bearing =
        view.azimuth + (problem.optics.equidistant ? std::atan2(ray.left, ray.ahead)
                                                   : std::atan((problem.optics.cx - sighting.middle) / view.fx));
    const double nx = -std::sin(bearing);
    const double ny = std::cos(bearing);
    const double offset = nx * view.x + ny * view.y;
    a[0] += nx * nx + kPrior;
    a[1] += nx * ny;
    a[2] += ny * ny + kPrior;
    b[0] += nx * offset + kPrior * (view.x + kUsual * ny);
    b[1] += ny * offset + kPrior * (view.y - kUsual * nx);
  }
  const double determinant = a[0] * a[2] - a[1] * a[1];
  ObjectValues values{};
  values[kCentreX] = (a[2] * b[0] - a[1] * b[1]) / determinant;
  values[kCentreY] = (a[0] * b[1] - a[1] * b[0]) / determinant;
  std::vector<double> radii;
  std::vector<double> tops;
  for (const Sighting& sighting : problem.sightings) {
    if (sighting.object != object || !sighting.left || !sighting.right) continue;
    const auto view = view_of(sighting);
    const double range = std::hypot(values[kCentreX] - view.x, values[kCentreY] - view.y);
    radii.push_back(range * (*sighting.right - *sighting.left) / (2 * view.fx));
    if (!sighting.top) continue;
    const auto ray = ray_of(sighting, *sighting.top);
    tops.push_back(started.estimate.camera[kHeight] - range * ray.down / std::hypot(ray.ahead, ray.left));
  }
  values[kRadius] = std::clamp(median_of(std::move(radii)), 0.01, 0.5);
  values[kTop] = std::clamp(median_of(std::move(tops)), 0.01, 2.0);
  return values;
}

PoseValues node_at(const OdometryTrack& odometry, const std::vector<PoseResult>& path, double t) {
  if (path.empty()) {
    const TrackPose pose = odometry.at(t);
    return {pose.x, pose.y, pose.heading};
  }
  // Pieces of the odometry from the path's nearest earlier pose.
  const auto next = std::ranges::upper_bound(path, t, {}, &PoseResult::t);
  const PoseResult& last = next == path.begin() ? *next : *(next - 1);
  const std::array<double, kPoseParameters> from = {last.x, last.y, last.heading};
  const auto pose = calibration::after(from.data(), calibration::motion_between(odometry.at(last.t), odometry.at(t)));
  return {pose.x, pose.y, pose.heading};
}

void start_estimate(const DriveLog& log, const std::vector<PoseResult>& path, StartedProblem& started) {
  const sensor::CameraMount& mount = log.camera.mount;
  CalibrationProblem& problem = started.problem;
  problem.configured = {0,
                        mount.yaw.to_double(),
                        mount.pitch ? mount.pitch->to_double() : 0,
                        log.camera.latency.to_double(),
                        mount.z.to_double(),
                        mount.x.to_double(),
                        mount.y.to_double(),
                        log.camera.k1.to_double()};
  problem.camera_sigma = kCameraSigma;
  problem.wheel_sigma = kWheelSigma;
  started.estimate.camera = problem.configured;
  for (const double t : problem.node_times) {
    PoseValues node = node_at(problem.odometry, path, t);
    if (!started.estimate.nodes.empty()) {
      // No heading is farther than half a turn from the one that odometry gives from the last node.
      const double last_t = problem.node_times[started.estimate.nodes.size() - 1];
      const double expected = started.estimate.nodes.back()[kPoseHeading] + problem.odometry.at(t).heading -
                              problem.odometry.at(last_t).heading;
      node[kPoseHeading] = expected + std::remainder(node[kPoseHeading] - expected, 2 * std::numbers::pi);
    }
    started.estimate.nodes.push_back(node);
  }
  // At first anything may be wrong by about a degree; what the noise is, is measured then.
  const double degree = problem.optics.fx * 0.02;
  problem.noise = {degree, degree, degree, degree, degree};
}

ConfiguredOptics optics_of(const sensor::CameraIntrinsics& camera) {
  return {camera.fx.to_double(),
          camera.fy.to_double(),
          camera.cx.to_double(),
          camera.cy.to_double(),
          static_cast<double>(camera.width),
          static_cast<double>(camera.height),
          camera.lens == sensor::Lens::kEquidistant};
}

}  // namespace

std::optional<std::string> too_few(std::size_t objects) {
  if (objects >= kMinObjects) return std::nullopt;
  return fmt::format("{} seen often enough ({} frames with a whole edge), and at least {} are needed; {}",
                     objects == 0 ? "no objects" : plural(objects, "object"), StartOptions{}.least_views, kMinObjects,
                     kGuide);
}

StartedProblem start_with(const DriveLog& log, const StartOptions& options, const std::vector<PoseResult>& path) {
  const OdometryTrack odometry(log.odometry);
  const double latency = log.camera.latency.to_double();
  const std::vector<SeenFrame> frames = frames_that_count(log, odometry, latency, options);
  StartedProblem started{
      {optics_of(log.camera), log.camera.mount.z.raw > 0, odometry, {}, {}}, {}, {}, {}, {}, frames.size()};
  started.problem.node_times = node_times(frames, odometry, latency, options.most_nodes);
  add_sightings(frames, latency, options, started);
  start_estimate(log, path, started);
  std::map<std::uint8_t, std::size_t> kinds;
  for (std::size_t o = 0; o < started.signatures.size(); ++o) {
    started.problem.kinds.push_back(kinds.emplace(started.signatures[o], kinds.size()).first->second);
    started.estimate.objects.push_back(first_guess(started, o));
    started.problem.radii.push_back(started.estimate.objects.back()[kRadius]);
  }
  started.estimate.kinds.resize(kinds.size());
  return started;
}

std::variant<StartedProblem, std::string> start_problem(const DriveLog& log) {
  if (log.odometry.size() < 2)
    return fmt::format("there is no odometry to speak of ($FPODO, or $FPCAR with car.counts set); {}", kGuide);
  const OdometryTrack odometry(log.odometry);
  if (const auto why = why_hopeless(log, odometry)) return *why;
  StartedProblem started = start_with(log, {}, {});
  if (const auto why = too_few(started.signatures.size())) return *why;
  return started;
}

}  // namespace fencepost::host
