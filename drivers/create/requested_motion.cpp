#include "drivers/create/requested_motion.hpp"

#include <algorithm>

#include "drivers/odometry/wheel_base.hpp"
#include "hal/base/check.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::create {
namespace {

using odometry::divide_nearest;

constexpr std::int64_t kPicometresPerTenthMicron = 100'000;
constexpr std::int64_t kMillimetre = 10'000;                             // of 0.1 um
constexpr std::int64_t kDegree = base::kTwoPiPicoradians / 360 / 1'000;  // nrad
// In whole mm or degrees. Motors that lag behind what is requested stay below.
constexpr std::int64_t kSurprise = 3;
// A prediction that misses what a reading can mean by a quarter of a unit or less is set to its end.
constexpr std::int64_t kNearly = 4;

/// Correction of the predicted motion since the last reading; whole units, fractions cut off towards zero.
std::int64_t correction(std::int64_t predicted, std::int64_t told, std::int64_t unit) {
  const std::int64_t low = (told > 0 ? told : told - 1) * unit;
  const std::int64_t high = (told < 0 ? told : told + 1) * unit;
  if (predicted >= low - unit / kNearly && predicted <= high + unit / kNearly) {
    return std::clamp(predicted, low, high) - predicted;
  }
  return (low + high) / 2 - predicted;
}

std::int64_t outwards(std::int64_t correction, std::int64_t predicted) {
  const bool less = predicted > 0 ? correction < 0 : predicted < 0 && correction > 0;
  return less ? 0 : correction;
}

bool surprising(std::int64_t correction, std::int64_t unit) {
  return correction > kSurprise * unit || correction < -kSurprise * unit;
}

}  // namespace

RequestedMotion::RequestedMotion(std::int64_t track_pm) : track_(track_pm / kPicometresPerTenthMicron) {
  FENCEPOST_CHECK(track_ > 0);
}

std::int64_t RequestedMotion::heading_urad() const {
  constexpr std::int64_t kMicro = 1'000'000;
  return corrected_urad_ + divide_nearest(lead_ * (kMicro / 2), track_);
}

void RequestedMotion::advance(std::int64_t way) { pose_.advance(way * kPicometresPerTenthMicron, heading_urad()); }

void RequestedMotion::request(std::int32_t left, std::int32_t right, base::Time t) {
  if (any_ && t > t_) {
    const std::int64_t passed = std::min(t - t_, kLongestStep).raw;
    const std::int64_t twice_left = (std::int64_t{left} + left_) * passed;
    const std::int64_t twice_right = (std::int64_t{right} + right_) * passed;
    const std::int64_t way = divide_nearest(twice_left + twice_right, 4);
    lead_ += twice_right - twice_left;
    way_ += way;
    advance(way);
  }
  any_ = true;
  left_ = left;
  right_ = right;
  t_ = t;
}

void RequestedMotion::read(const Reading& reading) {
  constexpr std::int64_t kNanoPerMicro = 1'000;
  const std::int64_t turned = (heading_urad() - heading_at_reading_) * kNanoPerMicro;
  std::int64_t turn = correction(turned, reading.degrees, kDegree);
  std::int64_t way = correction(way_, reading.mm, kMillimetre);
  if (reading.in_part) {
    turn = outwards(turn, turned);
    way = outwards(way, way_);
  }
  surprised_ = surprising(turn, kDegree) || surprising(way, kMillimetre);
  if (surprised_) ++surprises_;
  corrected_urad_ += divide_nearest(turn, kNanoPerMicro);
  advance(way);
  skip_reading();
}

void RequestedMotion::skip_reading() {
  way_ = 0;
  heading_at_reading_ = heading_urad();
}

}  // namespace fencepost::create
