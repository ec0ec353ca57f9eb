#include "firmware/recon/correspondence.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

// An end may be off by this angle for reasons outside the noise model (loose mounts, wheel slip): 3 deg;
constexpr float kSlackRadians = 0.05F;
// by this many sigmas of the prediction;
constexpr float kGateSigmas = 3.0F;
// and by this share of the predicted width (lost or grown pieces of a segment).
constexpr float kGateWidthShare = 0.5F;
// Behind a neighbour or the border an object may go on for this angle: 15 deg.
constexpr float kHiddenRadians = 0.26F;

// The foot's row may be off by this angle besides what distance and pitch explain: 1 deg.
constexpr float kRowSlackRadians = 0.0175F;

// Nothing is expected to be seen nearer, or farther (m), or this close to the border (share of the width).
constexpr float kNearestExpected = 0.1F;
constexpr float kFarthestExpected = 2.5F;
constexpr float kBorderShare = 0.05F;

// An object without a distance lies somewhere beyond this on its last bearing (m).
constexpr float kNearestUnknown = 0.15F;
// Directions with less than this forward share are not in any image.
constexpr float kSideways = 0.05F;

// Cost of an object whose distance is unknown: any well-placed one goes first.
constexpr std::uint8_t kUnknownCost = 150;
constexpr float kCostScale = 200.0F;

std::int16_t whole_pixels(float value) {
  constexpr float kFarOutside = 30'000.0F;
  const float clamped = std::clamp(value, -kFarOutside, kFarOutside);
  return static_cast<std::int16_t>(clamped < 0 ? clamped - 0.5F : clamped + 0.5F);
}

Vec2 to_camera(const LensPose& pose, const Vec2& map_direction) {
  return {pose.axis.dot(map_direction), cross(pose.axis, map_direction)};
}
Vec2 to_map(const LensPose& pose, const Vec2& camera_direction) { return rotated(pose.axis, camera_direction); }

// How far one tangent may be off, px. `ray` points along it, map axes; `reach` is the distance at which it touches.
float end_tolerance(const CameraModel& camera, const CylinderEstimate& estimate, const Vec2& normal, float reach,
                    float cos_bearing, const MeasurementNoise& noise) {
  const float pose_variance = noise.heading * noise.heading + noise.position * noise.position / (reach * reach);
  const float variance = estimate.covariance.along(normal) / (reach * reach) + pose_variance;
  return camera.fx / (cos_bearing * cos_bearing) * (kGateSigmas * std::sqrt(variance) + kSlackRadians);
}

// The row of the foot of an object that stands on the floor, and how far it may be off.
void predict_foot(const CameraModel& camera, const CylinderEstimate& estimate, const Vec2& axis,
                  const MeasurementNoise& noise, Prediction& prediction) {
  if (!camera.pitch_known || !(camera.height > 0)) return;
  const float drop = camera.height / prediction.depth;
  const float along = camera.pitch.x() + drop * camera.pitch.y();
  if (!(along > 0)) return;
  const float row = camera.cy + camera.fy * (drop * camera.pitch.x() - camera.pitch.y()) / along;
  const float depth_sigma = std::sqrt(estimate.covariance.along(-axis));
  const float spread = kGateSigmas * (drop * depth_sigma / prediction.depth + noise.pitch) + kRowSlackRadians;
  prediction.bottom = whole_pixels(row);
  prediction.bottom_tolerance = whole_pixels(std::max(1.0F, camera.fy * spread));
}

Prediction predict_cylinder(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                            const MeasurementNoise& noise) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  const Vec2 lens = offset_from(object.origin, pose.anchor) + pose.lens;
  const Vec2 away = estimate.center - lens;
  const float distance = std::sqrt(away.squaredNorm());
  Prediction prediction;
  if (!(distance > estimate.radius * 1.01F) || !(distance > 1e-3F)) return prediction;  // the lens is inside it
  const Vec2 bearing = to_camera(pose, away / distance);
  if (!(bearing.x() > kSideways)) return prediction;
  const float sine = estimate.radius / distance;
  const float cosine = std::sqrt(1.0F - sine * sine);
  const Vec2 left = rotated({cosine, sine}, bearing);
  const Vec2 right = rotated({cosine, -sine}, bearing);
  const float u_left = column_of(camera, left);
  const float u_right = column_of(camera, right);
  prediction.depth = std::max(1e-3F, bearing.x() * distance - estimate.radius);
  // Each end by its own uncertainty: an object seen from one side only has one good end.
  const float reach = distance * cosine;
  const float shape = kGateWidthShare * (u_right - u_left);
  const float left_tolerance =
      shape + end_tolerance(camera, estimate, left_of(to_map(pose, left)), reach, bearing.x(), noise);
  const float right_tolerance =
      shape + end_tolerance(camera, estimate, -left_of(to_map(pose, right)), reach, bearing.x(), noise);
  prediction.left = whole_pixels(u_left);
  prediction.right = whole_pixels(u_right);
  prediction.left_tolerance = whole_pixels(std::max(1.0F, left_tolerance));
  prediction.right_tolerance = whole_pixels(std::max(1.0F, right_tolerance));
  predict_foot(camera, estimate, pose.axis, noise, prediction);
  const auto columns = static_cast<float>(camera.width);
  prediction.possible = u_right + right_tolerance > 0 && u_left - left_tolerance < columns;
  const float border = kBorderShare * columns;
  prediction.expected =
      u_left > border && u_right < columns - border && distance > kNearestExpected && distance < kFarthestExpected;
  return prediction;
}

// No distance yet: the object is somewhere on its last bearing.
Prediction predict_bearing(const CameraModel& camera, const LensPose& pose, const ObjectCore& object) {
  const Vec2 lens = offset_from(object.origin, pose.anchor) + pose.lens;
  const Vec2 nearest = object.last_lens + kNearestUnknown * object.last_bearing - lens;
  const Vec2 far = to_camera(pose, object.last_bearing);
  const Vec2 near = to_camera(pose, nearest / std::max(1e-3F, std::sqrt(nearest.squaredNorm())));
  Prediction prediction;
  if (!(far.x() > kSideways)) return prediction;
  const float u_far = column_of(camera, far);
  const float u_near = column_of(camera, near);
  prediction.left = whole_pixels(std::min(u_far, u_near));
  prediction.right = whole_pixels(std::max(u_far, u_near));
  prediction.left_tolerance = whole_pixels(camera.fx * (kSlackRadians + (object.left_open ? kHiddenRadians : 0.0F)));
  prediction.right_tolerance = whole_pixels(camera.fx * (kSlackRadians + (object.right_open ? kHiddenRadians : 0.0F)));
  prediction.possible = true;
  return prediction;
}

float share_off(std::int16_t seen, std::int16_t predicted, std::int16_t tolerance) {
  return std::fabs(static_cast<float>(seen - predicted)) / static_cast<float>(tolerance);
}

bool may_lie_on_bearing(const Prediction& prediction, const Interval& interval) {
  const int center_twice = interval.left + interval.right;
  const int width = interval.right - interval.left;
  return center_twice > 2 * (prediction.left - prediction.left_tolerance) - width &&
         center_twice < 2 * (prediction.right + prediction.right_tolerance) + width;
}

}  // namespace

Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const MeasurementNoise& noise) {
  if (object.cylinder.estimate().ok()) return predict_cylinder(camera, pose, object, noise);
  return predict_bearing(camera, pose, object);
}

Interval interval_of(const CameraModel& camera, const BlobRays& rays) {
  return {whole_pixels(column_of(camera, rays.left.direction)), whole_pixels(column_of(camera, rays.right.direction)),
          rays.left.censored, rays.right.censored, rays.bottom.censored};
}

std::uint8_t match_cost(const Prediction& prediction, const Interval& interval, std::int16_t bottom_row) {
  if (!prediction.possible) return kImpossible;
  if (!(prediction.depth > 0)) return may_lie_on_bearing(prediction, interval) ? kUnknownCost : kImpossible;
  float off = 0;
  float parts = 0;
  if (!interval.left_censored) {
    off += share_off(interval.left, prediction.left, prediction.left_tolerance);
    parts += 1;
  }
  if (!interval.right_censored) {
    off += share_off(interval.right, prediction.right, prediction.right_tolerance);
    parts += 1;
  }
  if (!(parts > 0)) return overlaps(prediction, interval) ? kUnknownCost : kImpossible;
  if (!(off <= parts)) return kImpossible;
  if (!interval.bottom_censored && prediction.bottom_tolerance > 0) {
    // Beyond its tolerance the foot speaks against the pair but does not forbid it: the object may hang in the air.
    off += std::min(1.0F, share_off(bottom_row, prediction.bottom, prediction.bottom_tolerance));
    parts += 1;
  }
  return static_cast<std::uint8_t>(kCostScale * off / parts);
}

bool covers(const Prediction& prediction, const Interval& interval) {
  return prediction.possible && interval.left > prediction.left - prediction.left_tolerance &&
         interval.right < prediction.right + prediction.right_tolerance;
}

bool overlaps(const Prediction& prediction, const Interval& interval) {
  return prediction.possible && interval.right > prediction.left && interval.left < prediction.right;
}

}  // namespace fencepost::recon
