// Our own few trigonometric functions: the C libraries of our targets differ in the last bit, these do not.
#pragma once

#include <cstdint>

namespace fencepost::base {

/// A direction in the plane: cosine and sine of an angle.
struct SinCos {
  float cos = 1.0F;
  float sin = 0.0F;
};

/// Direction of an angle in microradians. Absolute error at most 9e-8 per component within +-1e4 rad; every other
/// int64 gives some unit direction. The argument is an integer so that a heading of 1000 rad costs no accuracy.
SinCos sincos_urad(std::int64_t microradians);

/// Angle of (x, y) in [-kPi, kPi], radians; atan2(0, 0) = 0, and a y of either zero gives +kPi for a negative x.
/// Absolute error at most 4e-7 rad. Both arguments finite.
float atan2_rad(float y, float x);

inline constexpr float kPi = 3.14159265F;
inline constexpr std::int64_t kTwoPiPicoradians = 6'283'185'307'180;

}  // namespace fencepost::base
