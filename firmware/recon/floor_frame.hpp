// The floor in whole millimetres, and directions in counts of 2^-14. On a small core, rotating a point then costs as
// much time as one float multiplication.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace fencepost::recon {

/// log2 of kSlopeOne: directions, cosines and slopes are counts of 2^-14.
inline constexpr int kSlopeBits = 14;
inline constexpr std::int32_t kSlopeOne = 1 << kSlopeBits;  ///< a cosine or slope of 1

inline constexpr float kMillimetresPerMetre = 1000;

/// a b of which b is a slope.
constexpr std::int32_t times(std::int32_t a, std::int32_t slope) { return (a * slope) >> kSlopeBits; }

// Cores without a float unit take nearest whole numbers from the floats' bits, in a sixth of the time.
#if defined(__arm__) && !defined(__ARM_FP)
inline constexpr bool kFloatUnit = false;
#else
inline constexpr bool kFloatUnit = true;
#endif

/// Half away from zero: what is left of the sum of `value` and a half when its fraction is cut off. The sum is rounded
/// as floats are, so the float next to 0.5 becomes 1. Inside 32 bits.
constexpr std::int32_t nearest_by_float(float value) {
  return static_cast<std::int32_t>(value < 0 ? value - 0.5F : value + 0.5F);
}

/// The same.
[[gnu::noinline]] inline std::int32_t nearest_by_bits(float value) {
  constexpr std::uint32_t kAmount = 0x7FFF'FFFF;
  constexpr std::uint32_t kBelowHalf = 0x3EFF'FFFF;  // the float next to 0.5
  constexpr int kFractionBits = 23;
  constexpr std::uint32_t kHidden = 1U << kFractionBits;
  constexpr std::uint32_t kOnlyWhole = (127U + kFractionBits) << kFractionBits;  // 2^23: no larger float has a fraction
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  const std::uint32_t amount = bits & kAmount;
  if (amount < kBelowHalf) return 0;
  if (amount >= kOnlyWhole) return nearest_by_float(value);
  const std::uint32_t places = 127U + kFractionBits - (amount >> kFractionBits);  // of the fraction: 1 to 25
  const std::uint32_t significand = (amount & (kHidden - 1)) | kHidden;
  std::uint32_t whole = 1;  // below 1
  if (places <= kFractionBits) whole = (significand + (1U << (places - 1))) >> places;
  return bits > kAmount ? -static_cast<std::int32_t>(whole) : static_cast<std::int32_t>(whole);
}

/// Nearest whole number, half away from zero; what is out of range comes out at +-limit, which is at most 2^24.
inline std::int32_t nearest_whole(float value, std::int32_t limit = 1 << 24) {
  const auto most = static_cast<float>(limit);
  if (kFloatUnit || !(std::fabs(value) < most)) value = std::clamp(value, -most, most);
  if constexpr (kFloatUnit) return nearest_by_float(value);
  return nearest_by_bits(value);
}

/// A point of the floor in the frame of an observer that looks along its own x axis, mm.
struct FloorPlace {
  std::int32_t depth = 0;
  std::int32_t left = 0;
};

/// The observer's position on the floor, mm, and its axis. Coordinates up to 32 m do not overflow.
struct FloorFrame {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t axis_x = kSlopeOne;
  std::int32_t axis_y = 0;

  [[nodiscard]] constexpr FloorPlace see(std::int32_t at_x, std::int32_t at_y) const {
    const std::int32_t dx = at_x - x;
    const std::int32_t dy = at_y - y;
    return {(axis_x * dx + axis_y * dy) >> kSlopeBits, (axis_x * dy - axis_y * dx) >> kSlopeBits};
  }
};

}  // namespace fencepost::recon
