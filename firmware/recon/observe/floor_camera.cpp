#include "firmware/recon/observe/floor_camera.hpp"

#include <algorithm>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/tuning.hpp"

namespace fencepost::recon {
namespace {

// Maximum size of a pinhole's image, in focal lengths: products stay inside 32 bits.
constexpr float kWidest = 4;
constexpr std::int32_t kWidestSlope = 2 * kSlopeOne - 1;  // half of it, the slope at the border
constexpr std::int32_t kSteepest = 4 * kSlopeOne;         // maximum slope on the floor
constexpr float kHighest = 4000;                          // mm, maximum height of the lens
constexpr std::int32_t kFarthestScale = 64'000;           // 2^-4 mm

// The factor f with f (1 + k1 f^2 r^2) = 1 that undoes the distortion, by c = k1 r^2: the series' coefficients are
// (3n)! / (n! (2n+1)!), and it converges up to 4/27. Stronger distortion counts as the strongest that it holds.
std::int32_t undistortion(std::int32_t c) {
  constexpr std::int32_t kStrongest = 2294;  // 0.14
  c = std::clamp(c, -kStrongest, kStrongest);
  constexpr std::int32_t kSeriesUnit = 1 << 10;
  std::int32_t sum = 55 * kSeriesUnit - ((273 * c) >> 4);
  sum = 12 * kSeriesUnit - times(sum, c);
  sum = 3 * kSeriesUnit - times(sum, c);
  sum = kSeriesUnit - times(sum, c);
  return kSlopeOne - ((sum * c) >> 10);
}

// The factor tan(a) / a of an equidistant lens, by a^2 in counts of kSlopeOne; beyond 78 degrees as there. Products
// stay inside 32 bits.
std::int32_t tangent_factor(std::int32_t square) {
  constexpr std::int32_t kWidestSquare = 30'364;
  const std::int32_t s = std::min(square, kWidestSquare);
  const std::int32_t fourth = (s * s) >> kSlopeBits;
  const std::int32_t above = 945 * kSlopeOne - 105 * s + fourth;
  const std::int32_t below = 945 * kSlopeOne - 420 * s + 15 * fourth;
  static_assert(kSlopeBits == 14);
  return (above << 7) / (below >> 7);
}

std::int32_t normalised(std::int32_t px, std::int32_t per_px) {
  return std::clamp((px * per_px) >> 12, -kWidestSlope, kWidestSlope);
}

}  // namespace

FloorCamera::FloorCamera(const CameraModel& camera) {
  const float height = 1000 * camera.height;
  const bool pinhole =
      static_cast<float>(camera.width) < kWidest * camera.fx && static_cast<float>(camera.rows) < kWidest * camera.fy;
  if (!camera.pitch_known || !(height >= 1) || height > kHighest || !pinhole) return;
  usable_ = true;
  centre_u_ = nearest_whole(16 * camera.cx);
  centre_v_ = nearest_whole(16 * camera.cy);
  constexpr float kInverse = 1 << 22;
  const float per_px_y = kInverse / camera.fy;
  per_px_x_ = nearest_whole(camera.fx == camera.fy ? per_px_y : kInverse / camera.fx);
  per_px_y_ = nearest_whole(per_px_y);
  constexpr auto kSlopesInOne = static_cast<float>(kSlopeOne);
  k1_ = nearest_whole(kSlopesInOne * camera.k1, kSlopeOne);
  bent_ = camera.bent;
  equidistant_ = camera.equidistant;
  pitch_cos_ = nearest_whole(kSlopesInOne * camera.pitch.x());
  pitch_sin_ = nearest_whole(kSlopesInOne * camera.pitch.y());
  height_ = nearest_whole(16 * height);
  per_row_ = nearest_whole(0.25F * per_px_y / height, 5000);
  find_limits(camera.width, camera.rows);
}

FloorCamera::Row FloorCamera::row_at(std::int32_t y) const {
  const std::int32_t drop = pitch_sin_ + times(y, pitch_cos_);
  Row row;
  row.forward = pitch_cos_ - times(y, pitch_sin_);
  if (row.forward <= 0 || drop <= 0) return row;
  const std::int32_t scale = (height_ << kSlopeBits) / drop;
  if (scale < kFarthestScale) row.depth = times(scale, row.forward) >> 4;
  return row;
}

FloorPoint FloorCamera::on(const Row& row, std::int32_t x) const {
  if (row.forward <= 0) return {};
  const std::int32_t across = pitch_sin_ == 0 ? x : (x << kSlopeBits) / row.forward;
  return {row.depth, std::clamp(-across, -kSteepest, kSteepest)};
}

FloorPoint FloorCamera::at(std::int32_t twice_u, std::int32_t twice_v) const {
  std::int32_t x = normalised(8 * twice_u - centre_u_, per_px_x_);
  std::int32_t y = normalised(8 * twice_v - centre_v_, per_px_y_);
  if (bent_) {
    const auto square = [&] { return ((x * x) >> kSlopeBits) + ((y * y) >> kSlopeBits); };
    const auto scale = [&](std::int32_t factor) {
      x = times(x, factor);
      y = times(y, factor);
    };
    if (k1_ != 0) scale(undistortion(times(square(), k1_)));
    if (equidistant_) scale(tangent_factor(square()));
  }
  return on(row_at(y), x);
}

FloorCamera::Pair FloorCamera::at(std::int32_t twice_left, std::int32_t twice_right, std::int32_t twice_v) const {
  if (bent_) return {at(twice_left, twice_v), at(twice_right, twice_v)};
  const Row row = row_at(normalised(8 * twice_v - centre_v_, per_px_y_));
  return {on(row, normalised(8 * twice_left - centre_u_, per_px_x_)),
          on(row, normalised(8 * twice_right - centre_u_, per_px_x_))};
}

// The foot of such an object appears between the middle row and the last one that the border does not cut.
void FloorCamera::find_limits(std::int32_t columns, std::int32_t rows) {
  const std::int32_t low = 2 * rows - 5;
  const std::int32_t left = 2 * kTouchPixels;
  const std::int32_t right = 2 * (columns - 1 - kTouchPixels);
  const FloorPoint low_left = at(left, low);
  const FloorPoint low_right = at(right, low);
  const std::int32_t nearest = std::max({at(columns, low).depth, low_left.depth, low_right.depth});
  nearest_visible_ = nearest + (nearest >> 4);
  leftmost_visible_ = std::min(low_left.slope, at(left, rows).slope);
  rightmost_visible_ = std::max(low_right.slope, at(right, rows).slope);
}

}  // namespace fencepost::recon
