// Our own few trigonometric functions: the C libraries of our targets differ in the last bit, these do not.
#pragma once

#include <cstdint>

namespace fencepost::base {

/// A direction in the plane: cosine and sine of an angle.
struct SinCos {
  float cos = 1.0F;
  float sin = 0.0F;
};

/// Direction of an angle given in microradians (any int64). Absolute error at most 1.2e-7 per component.
/// The argument is an integer so that a heading of 1000 rad costs no accuracy.
SinCos sincos_urad(std::int64_t microradians);

/// Angle of (x, y) in (-pi, pi], radians; atan2(0, 0) = 0. Absolute error at most 4e-7 rad.
float atan2_rad(float y, float x);

inline constexpr float kPi = 3.14159265F;
inline constexpr std::int64_t kTwoPiNanoradians = 6'283'185'307;

}  // namespace fencepost::base
