#include "firmware/recon/track/prediction.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/silhouette.hpp"
#include "firmware/recon/track/tuning.hpp"

namespace fencepost::recon {
namespace {

// The row where something `drop` below the horizon per metre of depth appears; sigma from the depth's relative one.
PredictedLine predict_row(const CameraModel& camera, float drop, float across, float relative_depth_sigma,
                          const MeasurementNoise& noise) {
  float row = 0;
  if (!row_of(camera, drop, across, row)) return {};
  const float sigma = camera.fy * (std::fabs(drop) * relative_depth_sigma + noise.pitch) + kRowPixels;
  return {whole_pixels(row), whole_pixels(sigma)};
}

// Foot and top of an object that stands on the floor.
void predict_rows(const CameraModel& camera, const ObjectCore& object, const CylinderEstimate& estimate,
                  const Vec2& axis, float across, const MeasurementNoise& noise, Prediction& prediction) {
  if (!camera.pitch_known || !(camera.height > 0)) return;
  const float relative = std::sqrt(estimate.covariance.along(-axis)) / prediction.depth;
  prediction.bottom = predict_row(camera, camera.height / prediction.depth, across, relative, noise);
  if (object.cylinder.first_views() < kFewestViews) return;
  const HeightRange band = object.band.at(estimate.center, estimate.radius);
  if (band.top_known) {
    prediction.top = predict_row(camera, (camera.height - band.z_max) / prediction.depth, across, relative, noise);
  }
}

// False if the foot may be below the image: the object may then be below it as a whole. True without a predicted row.
bool foot_inside(const CameraModel& camera, const PredictedLine& bottom) {
  return bottom.sigma == 0 || bottom.at + kFootSigmas * bottom.sigma < camera.rows - 1 - kBorderPixels;
}

// Sigma of a seen end around its prediction, px: of the tangent, the heading and the end itself.
float sigma_of(const TouchPoint& touch, float px_per_radian, const MeasurementNoise& noise) {
  const float tangent = touch.variance / touch.at.squared_norm() + noise.heading * noise.heading;
  return std::sqrt(px_per_radian * px_per_radian * tangent + noise.edge_px * noise.edge_px);
}

Prediction predict_place(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                         const CylinderEstimate& estimate, const Silhouette& seen, const MeasurementNoise& noise) {
  Prediction prediction;
  prediction.depth = seen.depth;
  const float u_left = column_of(camera, seen.left.at);
  const float u_right = column_of(camera, seen.right.at);
  const Vec2 middle = 0.5F * (seen.left.at + seen.right.at);
  const float px_per_radian = columns_per_radian(camera, middle);
  const float left_sigma = sigma_of(seen.left, px_per_radian, noise);
  const float right_sigma = sigma_of(seen.right, px_per_radian, noise);
  const float slack = kGateWidthShare * (u_right - u_left) + px_per_radian * kSlackRadians;
  const float left_tolerance = slack + kGateSigmas * left_sigma;
  const float right_tolerance = slack + kGateSigmas * right_sigma;
  prediction.left = {whole_pixels(u_left), whole_pixels(std::max(1.0F, left_sigma))};
  prediction.right = {whole_pixels(u_right), whole_pixels(std::max(1.0F, right_sigma))};
  prediction.left_tolerance = whole_pixels(std::max(1.0F, left_tolerance));
  prediction.right_tolerance = whole_pixels(std::max(1.0F, right_tolerance));
  const float across = camera.equidistant ? middle.y() / middle.x() : 0.0F;  // no other lens asks
  predict_rows(camera, object, estimate, pose.axis, across, noise, prediction);
  const auto columns = static_cast<float>(camera.width);
  const float near_square = middle.squared_norm();
  prediction.expected = foot_inside(camera, prediction.bottom) && u_left > kTouchPixels &&
                        u_right < columns - kTouchPixels && near_square > kNearestObject * kNearestObject &&
                        near_square < kRowMaxDepth * kRowMaxDepth;
  prediction.possible = u_right + right_tolerance > 0 && u_left - left_tolerance < columns;
  prediction.anywhere = !prediction.expected && std::min(left_sigma, right_sigma) >= kSomewhere * columns;
  return prediction;
}

// Variance that the estimate's own leaves out, m^2: shape and pose.
float others_of(const CylinderEstimate& estimate, const MeasurementNoise& noise) {
  const float shape = noise.roundness * estimate.radius;
  return shape * shape + noise.position * noise.position;
}

Prediction predict_cylinder(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                            const CylinderEstimate& estimate, const MeasurementNoise& noise) {
  Silhouette seen;
  if (!render(estimate, pose.lens_from(object.origin), pose, others_of(estimate, noise), seen)) return {};
  return predict_place(camera, pose, object, estimate, seen, noise);
}

// No distance yet: the object is somewhere on its last bearing, between the bounds that all its views leave.
Prediction predict_bearing(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                           const MeasurementNoise& noise) {
  const Vec2 lens = pose.lens_from(object.origin);
  const RangeBounds range = object.cylinder.range_along(object.last_lens, object.last_bearing);
  const auto direction_at = [&](float distance) {
    const Vec2 away = object.last_lens + distance * object.last_bearing - lens;
    return to_camera(pose, away / std::max(1e-3F, away.norm()));
  };
  const Vec2 far = range.most > 0 ? direction_at(range.most) : to_camera(pose, object.last_bearing);
  const Vec2 near = direction_at(range.least);
  Prediction prediction;
  if (!(far.x() > kSideways)) return prediction;
  const float u_far = column_of(camera, far);
  const float u_near = column_of(camera, near);
  prediction.left.at = whole_pixels(u_far);
  prediction.right.at = whole_pixels(u_near);
  // Of a bearing the middle was seen, whatever hides the ends.
  const auto tolerance = [&](End end) {
    if (object.cylinder.only_bearings()) return whole_pixels(camera.fx * kSlackRadians + kGateSigmas * noise.edge_px);
    return whole_pixels(camera.fx * (kSlackRadians + (is_edge(end) ? 0.0F : kHiddenRadians)));
  };
  prediction.left_tolerance = tolerance(object.left);
  prediction.right_tolerance = tolerance(object.right);
  // Without a distance the rows stay about where they were.
  const HeightBand::Sums& top = object.band.top();
  const HeightBand::Sums& bottom = object.band.bottom();
  if (top.views > 0) prediction.top = predict_row(camera, top.drop / top.views, far.y() / far.x(), kRowChange, noise);
  if (bottom.views > 0)
    prediction.bottom = predict_row(camera, bottom.drop / bottom.views, far.y() / far.x(), kRowChange, noise);
  prediction.possible = true;
  return prediction;
}

}  // namespace

Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const CylinderEstimate& estimate, const MeasurementNoise& noise) {
  if (!estimate.ok()) return predict_bearing(camera, pose, object, noise);
  return predict_cylinder(camera, pose, object, estimate, noise);
}

Prediction predict(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                   const PlacedOutline& outline, const MeasurementNoise& noise) {
  const CylinderEstimate& cylinder = object.cylinder.estimate();
  Silhouette seen;
  const Vec2 lens = pose.lens_from(outline.origin);
  if (!outline.known || !cylinder.ok() || !render(outline.view, lens, pose, others_of(cylinder, noise), seen)) {
    return predict(camera, pose, object, cylinder, noise);
  }
  return predict_place(camera, pose, object, cylinder, seen, noise);
}

}  // namespace fencepost::recon
