#include "firmware/recon/track/correspondence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "firmware/recon/models/silhouette.hpp"

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

// Rows are off by this many px besides what distance and pitch explain (whole pixels, rounded edges).
constexpr float kRowPixels = 1.5F;
// The height band is worth a prediction from this many views on.
constexpr std::uint8_t kViewsForTop = 3;

// Nothing is expected to be seen nearer, or farther (m), or this close to the border (share of the width).
constexpr float kNearestExpected = 0.1F;
constexpr float kFarthestExpected = 2.5F;
constexpr float kBorderShare = 0.05F;

// An object without a distance lies somewhere beyond this on its last bearing (m).
constexpr float kNearestUnknown = 0.15F;

// Cost of an object whose distance is unknown: any well-placed one goes first.
constexpr std::uint8_t kUnknownCost = 150;
constexpr float kUnknownCostNear = 100;
// Relative change of depth between sightings that its rows are expected to show.
constexpr float kRowChange = 0.15F;
constexpr float kCostScale = 200.0F;
// A side that is hidden or not predicted neither speaks for a pair nor against it: as much as one sigma and a half off.
constexpr float kCostOfUnknownSide = 0.25F;
constexpr float kSides = 4;

std::int16_t whole_pixels(float value) {
  constexpr float kFarOutside = 30'000.0F;
  if (!(std::fabs(value) < kFarOutside)) return static_cast<std::int16_t>(value < 0 ? -kFarOutside : kFarOutside);
  return static_cast<std::int16_t>(value + std::copysign(0.5F, value));
}

// The row where something `drop` below the horizon per metre of depth appears; sigma from the depth's relative one.
PredictedLine predict_row(const CameraModel& camera, float drop, float relative_depth_sigma,
                          const MeasurementNoise& noise) {
  const float along = camera.pitch.x() + drop * camera.pitch.y();
  if (!(along > 0)) return {};
  const float row = camera.cy + camera.fy * (drop * camera.pitch.x() - camera.pitch.y()) / along;
  const float sigma = camera.fy * (std::fabs(drop) * relative_depth_sigma + noise.pitch) + kRowPixels;
  return {whole_pixels(row), whole_pixels(sigma)};
}

// Foot and top of an object that stands on the floor.
void predict_rows(const CameraModel& camera, const ObjectCore& object, const CylinderEstimate& estimate,
                  const Vec2& axis, const MeasurementNoise& noise, Prediction& prediction) {
  if (!camera.pitch_known || !(camera.height > 0)) return;
  const float relative = std::sqrt(estimate.covariance.along(-axis)) / prediction.depth;
  prediction.bottom = predict_row(camera, camera.height / prediction.depth, relative, noise);
  if (object.cylinder.first_views() < kViewsForTop) return;
  const HeightRange band = object.band.at(estimate.center, estimate.radius);
  if (band.top_known) {
    prediction.top = predict_row(camera, (camera.height - band.z_max) / prediction.depth, relative, noise);
  }
}

// Sigma of a tangent, rad.
float sigma_of(const TouchPoint& touch, float heading) {
  return std::sqrt(touch.variance / touch.at.squaredNorm() + heading * heading);
}

Prediction predict_place(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                         const CylinderEstimate& estimate, const Silhouette& seen, const MeasurementNoise& noise) {
  Prediction prediction;
  prediction.depth = seen.depth;
  const float u_left = column_of(camera, seen.left.at);
  const float u_right = column_of(camera, seen.right.at);
  const Vec2 middle = 0.5F * (seen.left.at + seen.right.at);
  const float px_per_radian = camera.fx * middle.squaredNorm() / (middle.x() * middle.x());
  const float left_sigma = px_per_radian * sigma_of(seen.left, noise.heading);
  const float right_sigma = px_per_radian * sigma_of(seen.right, noise.heading);
  const float slack = kGateWidthShare * (u_right - u_left) + px_per_radian * kSlackRadians;
  const float left_tolerance = slack + kGateSigmas * left_sigma;
  const float right_tolerance = slack + kGateSigmas * right_sigma;
  prediction.left = {whole_pixels(u_left), whole_pixels(std::max(1.0F, left_sigma))};
  prediction.right = {whole_pixels(u_right), whole_pixels(std::max(1.0F, right_sigma))};
  prediction.left_tolerance = whole_pixels(std::max(1.0F, left_tolerance));
  prediction.right_tolerance = whole_pixels(std::max(1.0F, right_tolerance));
  predict_rows(camera, object, estimate, pose.axis, noise, prediction);
  const auto columns = static_cast<float>(camera.width);
  prediction.possible = u_right + right_tolerance > 0 && u_left - left_tolerance < columns;
  const float border = kBorderShare * columns;
  const float near_square = middle.squaredNorm();
  prediction.expected = u_left > border && u_right < columns - border &&
                        near_square > kNearestExpected * kNearestExpected &&
                        near_square < kFarthestExpected * kFarthestExpected;
  return prediction;
}

// Variance of what an estimate's own leaves out, m^2.
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

// No distance yet: the object is somewhere on its last bearing.
Prediction predict_bearing(const CameraModel& camera, const LensPose& pose, const ObjectCore& object,
                           const MeasurementNoise& noise) {
  const Vec2 lens = pose.lens_from(object.origin);
  const Vec2 nearest = object.last_lens + kNearestUnknown * object.last_bearing - lens;
  const Vec2 far = to_camera(pose, object.last_bearing);
  const Vec2 near = to_camera(pose, nearest / std::max(1e-3F, std::sqrt(nearest.squaredNorm())));
  Prediction prediction;
  if (!(far.x() > kSideways)) return prediction;
  const float u_far = column_of(camera, far);
  const float u_near = column_of(camera, near);
  prediction.left.at = whole_pixels(u_far);
  prediction.right.at = whole_pixels(u_near);
  prediction.left_tolerance = whole_pixels(camera.fx * (kSlackRadians + (object.left_open ? kHiddenRadians : 0.0F)));
  prediction.right_tolerance = whole_pixels(camera.fx * (kSlackRadians + (object.right_open ? kHiddenRadians : 0.0F)));
  // Without a distance the rows stay about where they were.
  const HeightBand::Sums& top = object.band.top();
  const HeightBand::Sums& bottom = object.band.bottom();
  if (top.views > 0) prediction.top = predict_row(camera, top.drop / top.views, kRowChange, noise);
  if (bottom.views > 0) prediction.bottom = predict_row(camera, bottom.drop / bottom.views, kRowChange, noise);
  prediction.possible = true;
  return prediction;
}

// Squared deviation in units of three sigmas, at most 1: a lost piece is no worse than that.
float cost_of_side(std::int16_t seen, bool censored, const PredictedLine& line) {
  if (censored || line.sigma == 0) return kCostOfUnknownSide;
  const float off = static_cast<float>(seen - line.at) / (kGateSigmas * static_cast<float>(line.sigma));
  return std::min(1.0F, off * off);
}

int reach_of(const PredictedLine& line) { return static_cast<int>(kGateSigmas) * line.sigma; }

bool agrees(std::int16_t seen, const PredictedLine& line) {
  return line.sigma > 0 && std::abs(seen - line.at) <= reach_of(line);
}

// Three sides where they should be: the fourth is where a segment was lost or another one grew into it.
bool all_but_one_agree(const Prediction& prediction, const Interval& interval, const Box& box) {
  int sides = 0;
  if (!interval.left_censored && agrees(interval.left, prediction.left)) ++sides;
  if (!interval.right_censored && agrees(interval.right, prediction.right)) ++sides;
  if (!interval.top_censored && agrees(box.y1, prediction.top)) ++sides;
  if (!interval.bottom_censored && agrees(box.y2, prediction.bottom)) ++sides;
  return sides >= 3;
}

// The outer end of one of two objects in a blob: where it should be, if it is seen and its place is known.
bool has_outer_end(const Prediction& prediction, std::int16_t seen, bool censored, const PredictedLine& line) {
  return censored || !(prediction.depth > 0) || agrees(seen, line);
}

float share_of(std::int16_t seen, std::int16_t predicted, std::int16_t tolerance) {
  return std::fabs(static_cast<float>(seen - predicted)) / static_cast<float>(tolerance);
}

// An object without a distance: possible anywhere on its bearing, likelier near where it was seen last.
std::uint8_t cost_on_bearing(const Prediction& prediction, const Interval& interval, const Box& box) {
  const int twice_center = interval.left + interval.right;
  const int width = interval.right - interval.left;
  const int low = std::min(prediction.left.at, prediction.right.at) - prediction.left_tolerance;
  const int high = std::max(prediction.left.at, prediction.right.at) + prediction.right_tolerance;
  if (twice_center <= 2 * low - width || twice_center >= 2 * high + width) return kImpossible;
  const float off = 0.5F * static_cast<float>(twice_center) - static_cast<float>(prediction.left.at);
  const auto reach = static_cast<float>(prediction.left_tolerance + prediction.right_tolerance + width);
  const float share = std::min(1.0F, std::fabs(off) / reach);
  const float cost = share + cost_of_side(box.y1, interval.top_censored, prediction.top) +
                     cost_of_side(box.y2, interval.bottom_censored, prediction.bottom);
  return static_cast<std::uint8_t>(kUnknownCostNear + (kUnknownCost - kUnknownCostNear) / 3 * cost);
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

Interval interval_of(const CameraModel& camera, const Box& box) {
  const float v_middle = 0.5F * static_cast<float>(box.y1 + box.y2);
  const Cut cut = cut_by_border(camera, box);
  return {whole_pixels(level_column(camera, static_cast<float>(box.x1) - 0.5F, v_middle)),
          whole_pixels(level_column(camera, static_cast<float>(box.x2) + 0.5F, v_middle)),
          cut.left,
          cut.right,
          cut.top,
          cut.bottom};
}

std::uint8_t match_cost(const Prediction& prediction, const Interval& interval, const Box& box) {
  if (!prediction.possible) return kImpossible;
  if (!(prediction.depth > 0)) return cost_on_bearing(prediction, interval, box);
  float off = 0;  // in shares of the tolerances: decides whether the pair is possible
  float ends = 0;
  if (!interval.left_censored) {
    off += share_of(interval.left, prediction.left.at, prediction.left_tolerance);
    ends += 1;
  }
  if (!interval.right_censored) {
    off += share_of(interval.right, prediction.right.at, prediction.right_tolerance);
    ends += 1;
  }
  if (!(ends > 0)) return overlaps(prediction, interval) ? kUnknownCost : kImpossible;
  if (!(off <= ends) && !all_but_one_agree(prediction, interval, box)) return kImpossible;
  // In sigmas: decides which pair is better. Rows never forbid a pair: the object may hang in the air.
  const float cost = cost_of_side(interval.left, interval.left_censored, prediction.left) +
                     cost_of_side(interval.right, interval.right_censored, prediction.right) +
                     cost_of_side(box.y1, interval.top_censored, prediction.top) +
                     cost_of_side(box.y2, interval.bottom_censored, prediction.bottom);
  return static_cast<std::uint8_t>(kCostScale / kSides * cost);
}

bool covers(const Prediction& prediction, const Interval& interval) {
  return prediction.depth > 0 && interval.left > prediction.left.at - reach_of(prediction.left) &&
         interval.right < prediction.right.at + reach_of(prediction.right);
}

bool has_middle_of(const Prediction& prediction, const Interval& interval) {
  const int twice_middle = interval.left + interval.right;
  return twice_middle >= 2 * (prediction.left.at - prediction.left.sigma) &&
         twice_middle <= 2 * (prediction.right.at + prediction.right.sigma);
}

void compare_ends(ObjectCore& object, const Prediction& prediction, const Interval& interval, const OpenEnds& ends) {
  const auto count = [](std::int8_t before, std::int16_t seen, const PredictedLine& line) -> std::int8_t {
    if (line.sigma == 0 || std::abs(seen - line.at) <= reach_of(line) + 1) return 0;
    constexpr int kMost = 100;
    const int step = seen < line.at ? -1 : 1;
    return static_cast<std::int8_t>(step * before > 0 ? std::clamp(before + step, -kMost, kMost) : step);
  };
  if (!(prediction.depth > 0)) return;
  if (!ends.left) object.left_off = count(object.left_off, interval.left, prediction.left);
  if (!ends.right) object.right_off = count(object.right_off, interval.right, prediction.right);
}

bool overlaps(const Prediction& prediction, const Interval& interval) {
  return prediction.possible && interval.right > std::min(prediction.left.at, prediction.right.at) &&
         interval.left < std::max(prediction.left.at, prediction.right.at);
}

bool shows_both(const Prediction& left, const Prediction& right, const Interval& interval, const Box& box) {
  if (!(left.depth > 0 || right.depth > 0) || !left.possible || !right.possible) return false;
  if (interval.left_censored && interval.right_censored) return false;
  if (!has_outer_end(left, interval.left, interval.left_censored, left.left)) return false;
  if (!has_outer_end(right, interval.right, interval.right_censored, right.right)) return false;
  if (left.depth > 0 && interval.right - left.right.at <= reach_of(left.right) + 1) return false;
  if (right.depth > 0 && right.left.at - interval.left <= reach_of(right.left) + 1) return false;
  if (!(left.depth > 0)) return left.left.at > interval.left && left.left.at < right.left.at;
  if (!(right.depth > 0)) return right.left.at < interval.right && right.left.at > left.right.at;
  const Prediction& nearer = left.depth < right.depth ? left : right;
  if (!interval.bottom_censored && nearer.bottom.sigma > 0 && !agrees(box.y2, nearer.bottom)) return false;
  return right.left.at - left.right.at <= reach_of(left.right) + reach_of(right.left) + 2;
}

bool hides_end(const Prediction& nearer, const Prediction& behind, std::int16_t column, int side) {
  constexpr float kSameDepth = 0.95F;  // closer together than this, models do not tell which is in front
  if (!nearer.confirmed || !(nearer.depth > 0) || !(behind.depth > 0)) return false;
  if (!(nearer.depth < kSameDepth * behind.depth)) return false;
  const PredictedLine& inner = side < 0 ? nearer.right : nearer.left;
  const PredictedLine& outer = side < 0 ? nearer.left : nearer.right;
  const int past_inner = side < 0 ? inner.at - column : column - inner.at;
  const int past_outer = side < 0 ? column - outer.at : outer.at - column;
  return past_inner >= -(inner.sigma + 1) && past_outer > 0;
}

}  // namespace fencepost::recon
