#include "firmware/alert/obstacle.hpp"

#include <algorithm>
#include <cmath>

#include "hal/base/trig.hpp"

namespace fencepost::alert {
namespace {

using recon::Vec2;

// Below this the robot counts as standing (m/s): its path is then straight ahead.
constexpr float kStanding = 0.01F;
// A range rate below this is not closing (m/s).
constexpr float kNotClosing = 0.005F;
// Arcs tighter than this are turns on the spot: the strip ahead is then straight (m).
constexpr float kTightestArc = 0.15F;
// Flatter arcs than this are straight to the eye (m).
constexpr float kFlattestArc = 50.0F;

void set_time_to_contact(const RobotPath& path, Obstacle& obstacle) {
  if (!obstacle.closing) return;
  obstacle.ttc = std::max(0.0F, obstacle.distance - path.body_radius) / obstacle.closing_speed;
}

// Is the disc (center, radius), robot frame, in the strip of half width w that the motion sweeps?
bool swept(const Vec2& center, float radius, const RobotPath& path) {
  const float direction = path.motion.forward < -kStanding ? -1.0F : 1.0F;
  const bool ahead = direction * center.x() > 0 || center.squaredNorm() < radius * radius;
  if (!ahead) return false;
  const float speed = std::fabs(path.motion.forward);
  const float turn = std::fabs(path.motion.turn);
  const bool arc = speed > kStanding && turn * kTightestArc < speed && turn * kFlattestArc > speed;
  if (!arc) return std::fabs(center.y()) - radius <= path.half_width;
  const float arc_radius = path.motion.forward / path.motion.turn;  // signed: positive turns left
  const Vec2 pivot{0, arc_radius};
  const float from_pivot = std::sqrt((center - pivot).squaredNorm());
  return std::fabs(from_pivot - std::fabs(arc_radius)) - radius <= path.half_width;
}

// Of the distance to the point that is nearest to who is at -away from the middle, m.
float sigma_of(const recon::CylinderEstimate& cylinder, const Vec2& away, float range) {
  return range > 0 ? std::sqrt(std::max(0.0F, cylinder.covariance.along(away / -range))) : 0.0F;
}

}  // namespace

RobotPlace::RobotPlace(const recon::MapPose& pose) : position(pose.position) {
  const base::SinCos direction = base::sincos_urad(pose.heading);
  heading = {direction.cos, direction.sin};
}

float Obstacle::bearing() const { return base::atan2_rad(toward.y(), toward.x()); }

Obstacle see_obstacle(const recon::ObjectCore& object, const RobotPlace& robot, const RobotPath& path) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  if (!cylinder.ok()) return {};
  const Vec2 away = cylinder.center - recon::offset_from(object.origin, robot.position);
  const Vec2 center{robot.heading.dot(away), recon::cross(robot.heading, away)};
  const float range = std::sqrt(center.squaredNorm());
  Obstacle obstacle;
  obstacle.known = true;
  obstacle.toward = center;
  obstacle.distance = std::max(0.0F, range - cylinder.radius);
  obstacle.cut_off = object.cut_off();
  if (swept(center, cylinder.radius, path)) obstacle.in_path = InPath{sigma_of(cylinder, away, range)};
  obstacle.closing_speed = range > 0 ? path.motion.forward * center.x() / range : 0.0F;
  obstacle.closing = obstacle.closing_speed > kNotClosing;
  set_time_to_contact(path, obstacle);
  return obstacle;
}

void measure_by_outline(const recon::OutlineView& outline, recon::MapPoint origin, const RobotPlace& robot,
                        const RobotPath& path, Obstacle& obstacle) {
  if (!outline.known_well()) return;
  std::size_t nearest = 0;
  const float distance = outline.distance_from(recon::offset_from(origin, robot.position), nearest);
  obstacle.distance = std::max(0.0F, distance);
  if (obstacle.in_path) obstacle.in_path->sigma = outline.sigma(nearest);
  set_time_to_contact(path, obstacle);
}

}  // namespace fencepost::alert
