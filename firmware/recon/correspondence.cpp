#include "firmware/recon/correspondence.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

// An end may be off by this angle for reasons outside the noise model (loose mounts, wheel slip): 3 deg.
constexpr float kSlackRadians = 0.05F;
// and by this many sigmas of the prediction,
constexpr float kGateSigmas = 3.0F;
// and by this share of the predicted width (lost or grown pieces of a segment).
constexpr float kGateWidthShare = 0.5F;

// Nothing is expected to be seen nearer, or farther (m), or this close to the border (share of the width).
constexpr float kNearestExpected = 0.1F;
constexpr float kFarthestExpected = 2.5F;
constexpr float kBorderShare = 0.05F;

// An object without a distance lies somewhere beyond this on its last bearing (m).
constexpr float kNearestUnknown = 0.15F;

// and, behind a neighbour or the border, may go on for this angle: 15 deg.
constexpr float kHiddenRadians = 0.26F;

// Cost of an object whose distance is unknown: any well-placed one goes first.
constexpr std::uint8_t kUnknownCost = 150;

// A share of the tolerance as a cost.
std::uint8_t cost_of(float share) {
  constexpr float kScale = 200.0F;
  return share <= 1.0F ? static_cast<std::uint8_t>(share * kScale) : kImpossible;
}

Vec2 to_camera(const LensPose& pose, const Vec2& map_direction) {
  return {pose.axis.dot(map_direction), cross(pose.axis, map_direction)};
}

Vec2 to_map(const LensPose& pose, const Vec2& camera_direction) { return rotated(pose.axis, camera_direction); }

Prediction predict_cylinder(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                            const MeasurementNoise& noise) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  const Vec2 lens = offset_from(object.origin, pose.anchor) + pose.lens;
  const Vec2 away = estimate.center - lens;
  const float distance = std::sqrt(away.squaredNorm());
  Prediction prediction;
  if (!(distance > estimate.radius * 1.01F) || !(distance > 1e-3F)) return prediction;  // the lens is inside it
  const Vec2 bearing = to_camera(pose, away / distance);
  if (!(bearing.x() > 0.05F)) return prediction;
  const float sine = estimate.radius / distance;
  const float cosine = std::sqrt(1.0F - sine * sine);
  const Vec2 left = rotated({cosine, sine}, bearing);
  const Vec2 right = rotated({cosine, -sine}, bearing);
  prediction.left = column_of(camera, left);
  prediction.right = column_of(camera, right);
  prediction.depth = std::max(1e-3F, bearing.x() * distance - estimate.radius);
  // Each end by its own uncertainty: an object seen from one side only has one good end.
  const Vec2 left_normal = left_of(to_map(pose, left));
  const Vec2 right_normal = -left_of(to_map(pose, right));
  const float reach = distance * cosine;
  const float pose_variance = noise.heading * noise.heading + noise.position * noise.position / (reach * reach);
  const float left_variance = estimate.covariance.along(left_normal) / (reach * reach) + pose_variance;
  const float right_variance = estimate.covariance.along(right_normal) / (reach * reach) + pose_variance;
  const float px_per_radian = camera.fx / (bearing.x() * bearing.x());
  const float shape = kGateWidthShare * (prediction.right - prediction.left);
  prediction.left_tolerance = px_per_radian * (kGateSigmas * std::sqrt(left_variance) + kSlackRadians) + shape;
  prediction.right_tolerance = px_per_radian * (kGateSigmas * std::sqrt(right_variance) + kSlackRadians) + shape;
  const auto columns = static_cast<float>(camera.width);
  prediction.possible =
      prediction.right + prediction.right_tolerance > 0 && prediction.left - prediction.left_tolerance < columns;
  const float border = kBorderShare * columns;
  prediction.expected = prediction.left > border && prediction.right < columns - border &&
                        distance > kNearestExpected && distance < kFarthestExpected;
  return prediction;
}

// No distance yet: the object is somewhere on its last bearing.
Prediction predict_bearing(const CameraModel& camera, const LensPose& pose, const ObjectCore& object) {
  const Vec2 lens = offset_from(object.origin, pose.anchor) + pose.lens;
  const Vec2 nearest = object.last_lens + kNearestUnknown * object.last_bearing - lens;
  const Vec2 far = to_camera(pose, object.last_bearing);
  const Vec2 near = to_camera(pose, nearest / std::max(1e-3F, std::sqrt(nearest.squaredNorm())));
  Prediction prediction;
  if (!(far.x() > 0.05F)) return prediction;
  const float u_far = column_of(camera, far);
  const float u_near = column_of(camera, near);
  prediction.left = std::min(u_far, u_near);
  prediction.right = std::max(u_far, u_near);
  prediction.left_tolerance = camera.fx * (kSlackRadians + (object.left_open ? kHiddenRadians : 0.0F));
  prediction.right_tolerance = camera.fx * (kSlackRadians + (object.right_open ? kHiddenRadians : 0.0F));
  prediction.possible = true;
  return prediction;
}

}  // namespace

Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const MeasurementNoise& noise) {
  if (object.cylinder.estimate().ok()) return predict_cylinder(camera, pose, object, noise);
  return predict_bearing(camera, pose, object);
}

Interval interval_of(const CameraModel& camera, const BlobRays& rays) {
  return {column_of(camera, rays.left.direction), column_of(camera, rays.right.direction), rays.left.censored,
          rays.right.censored, rays.bottom.censored};
}

std::uint8_t match_cost(const Prediction& prediction, const Interval& interval) {
  if (!prediction.possible) return kImpossible;
  if (!(prediction.depth > 0)) {
    const float center = 0.5F * (interval.left + interval.right);
    const float half = 0.5F * (interval.right - interval.left);
    const bool inside = center > prediction.left - prediction.left_tolerance - half &&
                        center < prediction.right + prediction.right_tolerance + half;
    return inside ? kUnknownCost : kImpossible;
  }
  if (interval.left_censored && interval.right_censored) {
    return overlaps(prediction, interval) ? kUnknownCost : kImpossible;
  }
  float error = 0;
  float ends = 0;
  if (!interval.left_censored) {
    error += std::fabs(interval.left - prediction.left) / prediction.left_tolerance;
    ends += 1;
  }
  if (!interval.right_censored) {
    error += std::fabs(interval.right - prediction.right) / prediction.right_tolerance;
    ends += 1;
  }
  return cost_of(error / ends);
}

bool covers(const Prediction& prediction, const Interval& interval) {
  return prediction.possible && interval.left > prediction.left - prediction.left_tolerance &&
         interval.right < prediction.right + prediction.right_tolerance;
}

bool overlaps(const Prediction& prediction, const Interval& interval) {
  return prediction.possible && interval.right > prediction.left && interval.left < prediction.right;
}

}  // namespace fencepost::recon
