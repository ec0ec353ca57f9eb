#include "host/simulate/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "host/scene/rounded_path.hpp"

namespace fencepost::host {

namespace {

/// `angle` plus whole turns, nearest to `reference`.
double near_to(double angle, double reference) {
  const double turns = std::round((reference - angle) / (2 * std::numbers::pi));
  return angle + turns * 2 * std::numbers::pi;
}

/// Drives straight from point to point and turns on the spot in between, the short way round.
std::vector<TimedPose> knots_of(const WaypointPath& path) {
  std::vector<TimedPose> knots;
  const std::vector<Point> points = driven_points(path);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point a = points[i];
    const Point b = points[i + 1];
    double heading = std::atan2(b.y - a.y, b.x - a.x);
    if (knots.empty()) {
      knots.push_back({0, a.x, a.y, heading});
      if (path.wait > 0) knots.push_back({path.wait, a.x, a.y, heading});
    } else {
      heading = near_to(heading, knots.back().heading);
      const double turn = std::abs(heading - knots.back().heading);
      if (turn > 0) knots.push_back({knots.back().t + turn / path.turn_rate, a.x, a.y, heading});
    }
    const double drive = std::hypot(b.x - a.x, b.y - a.y) / path.speed;
    knots.push_back({knots.back().t + drive, b.x, b.y, heading});
  }
  return knots;
}

int frames_in(double duration, double rate) {
  constexpr double kRounding = 1e-9;  // share of a frame; a path of exactly n frames has its last one
  return static_cast<int>(std::floor(duration * rate + kRounding)) + 1;
}

}  // namespace

std::vector<TimedPose> continuous(std::vector<TimedPose> poses) {
  for (std::size_t i = 1; i < poses.size(); ++i) poses[i].heading = near_to(poses[i].heading, poses[i - 1].heading);
  return poses;
}

TimedPose pose_between(std::span<const TimedPose> knots, double t) {
  const auto after =
      std::upper_bound(knots.begin(), knots.end(), t, [](double time, const TimedPose& knot) { return time < knot.t; });
  TimedPose pose = after == knots.begin() ? knots.front() : *(after - 1);
  if (after != knots.begin() && after != knots.end()) {
    const double share = (t - pose.t) / (after->t - pose.t);
    pose.x += share * (after->x - pose.x);
    pose.y += share * (after->y - pose.y);
    pose.heading += share * (after->heading - pose.heading);
  }
  pose.t = t;
  return pose;
}

Trajectory::Trajectory(const Scene& scene) : scene_(scene) {
  if (const auto* arc = std::get_if<ArcPath>(&scene.path)) {
    frames_ = arc->views;
    duration_ = (arc->views - 1) / scene.rate;
    return;
  }
  if (const auto* waypoints = std::get_if<WaypointPath>(&scene.path)) {
    knots_ = waypoints->turn_radius > 0 ? rounded_knots(*waypoints) : knots_of(*waypoints);
  }
  if (const auto* poses = std::get_if<PosesPath>(&scene.path)) knots_ = continuous(poses->poses);
  duration_ = knots_.back().t;
  frames_ = frames_in(duration_, scene.rate);
}

Trajectory::Trajectory(const Scene& scene, std::function<TimedPose(double t)> driver, double duration)
    : scene_(scene), driver_(std::move(driver)), duration_(duration), frames_(frames_in(duration, scene.rate)) {}

TimedPose Trajectory::at(double t) const {
  if (driver_) return driver_(t);
  if (const auto* arc = std::get_if<ArcPath>(&scene_.path)) return on_arc(*arc, t);
  return pose_between(knots_, t);
}

TimedPose Trajectory::on_arc(const ArcPath& arc, double t) const {
  const double share = duration_ > 0 ? std::clamp(t / duration_, 0.0, 1.0) : 0.0;
  const double angle = arc.start + share * arc.sweep;
  const double outwards = arc.look_outwards ? 0 : std::numbers::pi;
  return {t, arc.center.x + arc.radius * std::cos(angle), arc.center.y + arc.radius * std::sin(angle),
          angle + outwards - scene_.camera.mount.yaw.to_double()};
}

}  // namespace fencepost::host
