#include "host/simulate/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const Point a = path.points[i];
    const Point b = path.points[i + 1];
    double heading = std::atan2(b.y - a.y, b.x - a.x);
    if (knots.empty()) {
      knots.push_back({0, a.x, a.y, heading});
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

std::vector<TimedPose> knots_of(const PosesPath& path) {
  std::vector<TimedPose> knots = path.poses;
  for (std::size_t i = 1; i < knots.size(); ++i) knots[i].heading = near_to(knots[i].heading, knots[i - 1].heading);
  return knots;
}

}  // namespace

Trajectory::Trajectory(const Scene& scene) : scene_(scene) {
  if (const auto* arc = std::get_if<ArcPath>(&scene.path)) {
    frames_ = arc->views;
    duration_ = (arc->views - 1) / scene.rate;
    return;
  }
  if (const auto* waypoints = std::get_if<WaypointPath>(&scene.path)) knots_ = knots_of(*waypoints);
  if (const auto* poses = std::get_if<PosesPath>(&scene.path)) knots_ = knots_of(*poses);
  duration_ = knots_.back().t;
  constexpr double kRounding = 1e-9;  // share of a frame; a path of exactly n frames has its last one
  frames_ = static_cast<int>(std::floor(duration_ * scene.rate + kRounding)) + 1;
}

TimedPose Trajectory::at(double t) const {
  if (const auto* arc = std::get_if<ArcPath>(&scene_.path)) return on_arc(*arc, t);
  return between_knots(t);
}

TimedPose Trajectory::on_arc(const ArcPath& arc, double t) const {
  const double share = duration_ > 0 ? std::clamp(t / duration_, 0.0, 1.0) : 0.0;
  const double angle = arc.start + share * arc.sweep;
  const double outwards = arc.look_outwards ? 0 : std::numbers::pi;
  return {t, arc.center.x + arc.radius * std::cos(angle), arc.center.y + arc.radius * std::sin(angle),
          angle + outwards - scene_.camera.mount.yaw.to_double()};
}

TimedPose Trajectory::between_knots(double t) const {
  const auto after = std::upper_bound(knots_.begin(), knots_.end(), t,
                                      [](double time, const TimedPose& knot) { return time < knot.t; });
  TimedPose pose = after == knots_.begin() ? knots_.front() : *(after - 1);
  if (after != knots_.begin() && after != knots_.end()) {
    const double share = (t - pose.t) / (after->t - pose.t);
    pose.x += share * (after->x - pose.x);
    pose.y += share * (after->y - pose.y);
    pose.heading += share * (after->heading - pose.heading);
  }
  pose.t = t;
  return pose;
}

}  // namespace fencepost::host
