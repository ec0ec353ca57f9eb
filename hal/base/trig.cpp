#include "hal/base/trig.hpp"

namespace fencepost::base {
namespace {

constexpr std::int64_t kHalfPiNanoradians = 1'570'796'327;

// Taylor series to x^9 / x^8 on [-pi/4, pi/4]: truncation below 2e-9, so float rounding dominates.
float sine_of_octant(float x) {
  const float q = x * x;
  return x * (1.0F + q * (-1.66666667e-1F + q * (8.33333333e-3F + q * (-1.98412698e-4F + q * 2.75573192e-6F))));
}
float cosine_of_octant(float x) {
  const float q = x * x;
  return 1.0F + q * (-0.5F + q * (4.16666667e-2F + q * (-1.38888889e-3F + q * (2.48015873e-5F - q * 2.75573192e-7F))));
}

// Odd minimax-like polynomial for atan on [0, tan(pi/8)], series to x^15: truncation below 3e-8.
float atan_small(float x) {
  const float q = x * x;
  return x * (1.0F +
              q * (-3.33333333e-1F +
                   q * (2.0e-1F + q * (-1.42857143e-1F + q * (1.11111111e-1F + q * (-9.09090909e-2F + q * (7.69230769e-2F - q * 6.66666667e-2F)))))));
}

constexpr float kTanPi8 = 0.414213562F;

// atan on [0, 1], by the identity atan(x) = pi/4 - atan((1-x)/(1+x)) above tan(pi/8).
float atan_unit(float x) {
  if (x <= kTanPi8) return atan_small(x);
  return 0.25F * kPi - atan_small((1.0F - x) / (1.0F + x));
}

}  // namespace

SinCos sincos_urad(std::int64_t microradians) {
  // Whole turns go first, in integers of 1 nrad: at 1000 rad the error of 2 pi adds up to 30 nrad only.
  constexpr std::int64_t kTurnsOfHeadroom = 1'000'000'000;  // |microradians| <= 9.2e15 stays in range below
  if (microradians > kTurnsOfHeadroom * 6'000 || microradians < -kTurnsOfHeadroom * 6'000) microradians %= 6'283'185;
  std::int64_t nano = (microradians * 1000) % kTwoPiNanoradians;
  if (nano < 0) nano += kTwoPiNanoradians;
  // Nearest quarter turn, and the rest within +-pi/4.
  const std::int64_t quarter = (nano + kHalfPiNanoradians / 2) / kHalfPiNanoradians;
  const auto rest = static_cast<float>(static_cast<std::int32_t>(nano - quarter * kHalfPiNanoradians)) * 1e-9F;
  const float s = sine_of_octant(rest);
  const float c = cosine_of_octant(rest);
  switch (quarter & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

float atan2_rad(float y, float x) {
  const float ax = x < 0 ? -x : x;
  const float ay = y < 0 ? -y : y;
  if (ax == 0 && ay == 0) return 0;
  float angle = ay <= ax ? atan_unit(ay / ax) : 0.5F * kPi - atan_unit(ax / ay);
  if (x < 0) angle = kPi - angle;
  return y < 0 ? -angle : angle;
}

}  // namespace fencepost::base
