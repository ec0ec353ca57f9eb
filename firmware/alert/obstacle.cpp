#include "firmware/alert/obstacle.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/alert/tuning.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::alert {
namespace {

using recon::Vec2;

// way_to() over the speed, but for the last bit: logs hold what this gave.
void set_time_to_contact(const RobotPath& path, Obstacle& obstacle) {
  if (!obstacle.closing) return;
  const float speed = std::fabs(path.motion.forward);
  const float edge = path.motion.forward > 0 ? path.front : path.rear;
  if (edge > 0 && std::fabs(obstacle.toward.y()) <= path.half_width) {
    const float along = obstacle.distance * obstacle.closing_speed / speed;
    obstacle.ttc = std::max(0.0F, along - edge) / speed;
  } else {
    const float reach = edge > 0 ? edge : path.body_radius;
    obstacle.ttc = std::max(0.0F, obstacle.distance - reach) / obstacle.closing_speed;
  }
}

void set_closing(const RobotPath& path, float range, Obstacle& obstacle) {
  obstacle.closing_speed = range > 0 ? path.motion.forward * obstacle.toward.x() / range : 0.0F;
  obstacle.closing = obstacle.closing_speed > kNotClosing;
  set_time_to_contact(path, obstacle);
}

// Sigma (m) of the distance from a place at -away from the middle to the cylinder's nearest point.
float sigma_of(const recon::CylinderEstimate& cylinder, const Vec2& away, float range) {
  return range > 0 ? std::sqrt(std::max(0.0F, cylinder.covariance.along(away / -range))) : 0.0F;
}

// A thing that approaches by itself is farther than its edges say, and passes farther aside. A thing on a base is where
// they say. So the margin is not for what rows put farther: only contact with the body counts.
bool touches(const SweptByBody& swept, const recon::ObjectCore& object, const Vec2& center) {
  const float radius = object.cylinder.estimate().radius;
  if (!swept.touches(center, radius)) return false;
  const float margin = swept.path().half_width - swept.path().body_radius;
  return swept.touches(center, radius - margin) || !object.cylinder.rows_put_farther();
}

// `center`: of the outline, robot frame. From the nearest side on, for it is the likeliest, in steps that no path of
// the robot's width passes between.
bool touches(const SweptByBody& swept, const recon::OutlineView& outline, const Vec2& center, const RobotPlace& robot,
             std::size_t nearest) {
  const std::size_t sides = outline.offsets.size();
  const auto corner = [&](std::size_t k) {
    return Vec2(center + robot.see(outline.corner(k < sides ? k : k - sides)));
  };
  const float per_metre = 1 / swept.path().half_width;
  const SweptBounds<float> bounds = swept.bounds_of(0);
  Vec2 from = corner(nearest + sides - 1);
  for (std::size_t k = nearest; k < nearest + sides; ++k) {
    const Vec2 to = corner(k);
    const Vec2 side = to - from;
    const int pieces = 1 + static_cast<int>(per_metre * (std::fabs(side.x()) + std::fabs(side.y())));
    const Vec2 step = pieces > 1 ? Vec2(side / static_cast<float>(pieces)) : side;
    for (int i = 0; i < pieces; ++i, from += step) {
      if (swept.touches(from, bounds)) return true;
    }
    from = to;
  }
  return false;
}

}  // namespace

RobotPlace::RobotPlace(const recon::MapPose& pose) : position(pose.position) {
  const base::SinCos direction = base::sincos_urad(pose.heading);
  heading = {direction.cos, direction.sin};
}

float Obstacle::bearing() const { return base::atan2_rad(toward.y(), toward.x()); }

// A thing straight ahead of a straight end touches at that edge; all others touch at the distance of the edge.
float way_to(const RobotPath& path, const Obstacle& obstacle, float share) {
  const float edge = obstacle.toward.x() > 0 ? path.front : path.rear;
  const bool flat = edge > 0 && std::fabs(obstacle.toward.y()) <= path.half_width;
  if (flat) return std::max(0.0F, obstacle.distance * share - edge);
  return std::max(0.0F, obstacle.distance - (edge > 0 ? edge : path.body_radius)) / share;
}

void set_closing(const RobotPath& path, Obstacle& obstacle) { set_closing(path, obstacle.toward.norm(), obstacle); }

Obstacle see_obstacle(const recon::ObjectCore& object, const RobotPlace& robot, const SweptByBody& swept) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  if (!cylinder.ok()) return {};
  const Vec2 away = cylinder.center - recon::offset_from(object.origin, robot.position);
  const Vec2 center = robot.see(away);
  const float range = center.norm();
  Obstacle obstacle;
  obstacle.known = true;
  obstacle.toward = center;
  obstacle.distance = std::max(0.0F, range - cylinder.radius);
  obstacle.cut_off = object.cut_off();
  obstacle.guessed = !object.cylinder.known_whole();
  obstacle.overhang = swept.overhang(center);
  if (touches(swept, object, center)) obstacle.in_path = InPath{sigma_of(cylinder, away, range)};
  set_closing(swept.path(), range, obstacle);
  return obstacle;
}

void measure_by_outline(const recon::PlacedOutline& outline, const RobotPlace& robot, const SweptByBody& swept,
                        Obstacle& obstacle) {
  if (!outline.known) return;
  std::size_t nearest = 0;
  const Vec2 center = recon::offset_from(robot.position, outline.origin);
  const float distance = outline.view.distance_from(-center, nearest);
  obstacle.distance = std::max(0.0F, distance);
  if (obstacle.in_path) {
    obstacle.in_path->sigma = outline.view.sigma(nearest);
    if (distance > 0 && !touches(swept, outline.view, robot.see(center), robot, nearest)) obstacle.in_path.reset();
  }
  set_time_to_contact(swept.path(), obstacle);
}

}  // namespace fencepost::alert
