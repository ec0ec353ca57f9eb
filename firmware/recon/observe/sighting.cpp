#include "firmware/recon/observe/sighting.hpp"

#include <cmath>

#include "hal/base/trig.hpp"

namespace fencepost::recon {

LensPose lens_pose(const MapPose& robot, const CameraModel& camera) {
  const base::SinCos heading = base::sincos_urad(robot.heading);
  const Vec2 map_R_robot{heading.cos, heading.sin};
  return {robot.position, rotated(map_R_robot, camera.position), rotated(map_R_robot, camera.yaw)};
}

Sighting make_sighting(const CameraModel& camera, const LensPose& pose, const Observation& observation) {
  const Box& box = observation.box;
  const float u_middle = 0.5F * (left_edge(box) + right_edge(box));
  const PixelRow middle(camera, 0.5F * (top_edge(box) + bottom_edge(box)));
  const auto direction = [&](float u) { return rotated(pose.axis, middle.ground_direction(u)); };
  Sighting sighting;
  sighting.anchor = pose.anchor;
  sighting.lens = pose.lens;
  sighting.axis = pose.axis;
  sighting.center = direction(u_middle);
  const auto edge = [&](float u, bool left) {
    if (!camera.equidistant) return direction(u);
    return rotated(pose.axis, ground_direction(camera, u, row_of_edge(camera, box, left)));
  };
  sighting.left = {edge(left_edge(box), true), observation.left};
  sighting.right = {edge(right_edge(box), false), observation.right};
  sighting.top = {drop_per_depth(camera, u_middle, top_edge(box)), observation.top};
  sighting.bottom = {drop_per_depth(camera, u_middle, bottom_edge(box)), observation.bottom};
  sighting.focal = camera.fx;
  constexpr float kRadiusPerMillimetre = 0.0005F;
  sighting.known_radius = kRadiusPerMillimetre * static_cast<float>(observation.width);
  sighting.bearing = observation.bearing;
  sighting.equidistant = camera.equidistant;
  const Sides cut = cut_by_border(camera, box);
  sighting.cut_at_side = cut.left || cut.right;
  sighting.lens_height = camera.height;
  sighting.rows_known = camera.pitch_known && camera.height > 0;
  return sighting;
}

HalfPlane left_tangent(const Sighting& sighting, MapPoint origin) {
  const Vec2 normal = left_of(sighting.left.direction);
  return {normal, normal.dot(sighting.lens_from(origin))};
}

HalfPlane right_tangent(const Sighting& sighting, MapPoint origin) {
  const Vec2 normal = -left_of(sighting.right.direction);
  return {normal, normal.dot(sighting.lens_from(origin))};
}

float direction_variance(const Sighting& sighting, const Ray& ray, const MeasurementNoise& noise) {
  const float cos_beta = ray.direction.dot(sighting.axis);
  const float narrowing = sighting.equidistant ? 1.0F : cos_beta * cos_beta;
  const float pixel = narrowing / sighting.focal * noise.edge_px;
  return pixel * pixel + noise.heading * noise.heading;
}

float edge_variance(float direction, float distance, const MeasurementNoise& noise) {
  return distance * distance * direction + noise.position * noise.position;
}

namespace {

RowDepth depth_of_bottom(const Sighting& sighting, const MeasurementNoise& noise) {
  if (!sighting.rows_known) return {};
  if (sighting.bottom.drop * kRowMaxDepth < sighting.lens_height) return {};
  const float depth = sighting.lens_height / sighting.bottom.drop;
  // dX = X^2 / (f h) dv; the pitch moves the row by f dpitch.
  const float per_radian = depth * depth / sighting.lens_height;
  const float row = noise.row_px / sighting.focal;
  const float variance =
      per_radian * per_radian * (row * row + noise.pitch * noise.pitch) + noise.position * noise.position;
  return {true, depth, variance};
}

}  // namespace

RowDepth row_depth(const Sighting& sighting, const MeasurementNoise& noise) {
  return is_edge(sighting.bottom.end) && !sighting.no_edge() ? depth_of_bottom(sighting, noise) : RowDepth{};
}

RowDepth farthest_row_depth(const Sighting& sighting, const MeasurementNoise& noise) {
  return sighting.bottom.end != End::kOccluded ? depth_of_bottom(sighting, noise) : RowDepth{};
}

RowDepth hidden_row_depth(const Sighting& sighting) {
  if (!sighting.rows_known || is_edge(sighting.bottom.end)) return {};
  if (sighting.no_edge()) return {};
  if (sighting.bottom.drop * kRowMaxDepth < sighting.lens_height) return {};
  const float farthest = sighting.lens_height / sighting.bottom.drop;
  return {true, kHiddenFootMean * farthest, kHiddenFootSigma * kHiddenFootSigma * farthest * farthest};
}

}  // namespace fencepost::recon
