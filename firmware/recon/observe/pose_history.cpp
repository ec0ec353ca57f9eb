#include "firmware/recon/observe/pose_history.hpp"

#include <limits>

#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

constexpr std::int64_t kTwoPiMicroradians = 6'283'185;

constexpr bool fits_32_bits(std::int64_t value) {
  return value <= std::numeric_limits<std::int32_t>::max() && value >= std::numeric_limits<std::int32_t>::min();
}

// Most differences are small, and a small core divides 32 bits ten times as fast as 64.
std::int64_t quotient(std::int64_t dividend, std::int64_t divisor) {
  if (!fits_32_bits(dividend) || !fits_32_bits(divisor)) return dividend / divisor;
  return static_cast<std::int32_t>(dividend) / static_cast<std::int32_t>(divisor);
}

// a + (b - a) num / den, half away from zero, in integers.
std::int32_t between(std::int32_t a, std::int64_t difference, std::int64_t num, std::int64_t den) {
  const std::int64_t product = difference * num;
  const std::int64_t half = product < 0 ? -den / 2 : den / 2;
  return static_cast<std::int32_t>(a + quotient(product + half, den));
}

}  // namespace

std::int64_t short_way(std::int64_t microradians) {
  const bool whole_turns = microradians >= kTwoPiMicroradians || microradians <= -kTwoPiMicroradians;
  std::int64_t wrapped = whole_turns ? microradians % kTwoPiMicroradians : microradians;
  if (wrapped > kTwoPiMicroradians / 2) wrapped -= kTwoPiMicroradians;
  if (wrapped < -kTwoPiMicroradians / 2) wrapped += kTwoPiMicroradians;
  return wrapped;
}

MapPose to_map_pose(const sensor::OdometrySample& sample) {
  constexpr std::int32_t kMapUnitsPerTenthMillimetre = kMapUnitsPerMetre / base::Metres::kPerUnit;
  constexpr std::int32_t kMicroradiansPerUnit = 1'000'000 / base::Radians::kPerUnit;
  return {{sample.x.raw * kMapUnitsPerTenthMillimetre, sample.y.raw * kMapUnitsPerTenthMillimetre},
          sample.heading.raw * kMicroradiansPerUnit};
}

MapPose interpolate(const PoseSample& before, const PoseSample& after, std::uint32_t at) {
  const auto num = static_cast<std::int64_t>(at - before.ticks);
  const auto den = static_cast<std::int64_t>(after.ticks - before.ticks);
  const auto straight = [&](std::int32_t a, std::int32_t b) {
    return between(a, static_cast<std::int64_t>(b) - a, num, den);
  };
  MapPose pose;
  pose.position.x = straight(before.pose.position.x, after.pose.position.x);
  pose.position.y = straight(before.pose.position.y, after.pose.position.y);
  const std::int64_t turn = short_way(static_cast<std::int64_t>(after.pose.heading) - before.pose.heading);
  pose.heading = between(before.pose.heading, turn, num, den);
  return pose;
}

Motion motion_between(const PoseSample& before, const PoseSample& after) {
  const auto ticks = static_cast<std::int32_t>(after.ticks - before.ticks);
  if (ticks <= 0) return {};
  const float seconds = static_cast<float>(ticks) / static_cast<float>(base::Time::kPerUnit);
  const std::int64_t turn = short_way(static_cast<std::int64_t>(after.pose.heading) - before.pose.heading);
  const base::SinCos middle = base::sincos_urad(before.pose.heading + turn / 2);
  const Vec2 step = offset_from(before.pose.position, after.pose.position);
  return {(middle.cos * step.x() + middle.sin * step.y()) / seconds, static_cast<float>(turn) * 1e-6F / seconds};
}

}  // namespace fencepost::recon
