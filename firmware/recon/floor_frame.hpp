// The floor in whole millimetres, directions in counts of 2^-14: a small core turns a point in the time that it takes
// for one multiplication of floats.
#pragma once

#include <algorithm>
#include <cstdint>

namespace fencepost::recon {

/// Directions, cosines and slopes are counts of 2^-14.
inline constexpr int kSlopeBits = 14;
inline constexpr std::int32_t kSlopeOne = 1 << kSlopeBits;

inline constexpr float kMillimetresPerMetre = 1000;

/// a b of which b is a slope.
constexpr std::int32_t times(std::int32_t a, std::int32_t slope) { return (a * slope) >> kSlopeBits; }

/// Nearest whole number, half away from zero; what is out of range comes out at +-limit.
constexpr std::int32_t nearest_whole(float value, std::int32_t limit = 1 << 24) {
  const auto most = static_cast<float>(limit);
  const float kept = std::clamp(value, -most, most);
  return static_cast<std::int32_t>(kept < 0 ? kept - 0.5F : kept + 0.5F);
}

/// A place on the floor as one that looks along its own x axis has it, mm.
struct FloorPlace {
  std::int32_t depth = 0;
  std::int32_t left = 0;
};

/// Where such a one is on the floor, mm, and its axis. Within 32 m everything fits.
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
