#include "hal/base/trig.hpp"

namespace fencepost::base {
namespace {

constexpr std::int64_t kHalfPiPicoradians = 1'570'796'326'795;

// Taylor series on [-pi/4, pi/4], sine to x^9, cosine to x^10: truncation below 2e-9, so float rounding dominates.
// Each returns its function minus the leading term, which the caller adds last, rounding once.
float sine_tail(float x, float q) {
  return x * (q * (-1.66666667e-1F + q * (8.33333333e-3F + q * (-1.98412698e-4F + q * 2.75573192e-6F))));
}
float cosine_tail(float q) {
  return q * (-0.5F + q * (4.16666667e-2F + q * (-1.38888889e-3F + q * (2.48015873e-5F - q * 2.75573192e-7F))));
}

// A thousandth, towards zero, of a value below 2^40. Small cores do two divisions of 32 bits many times as fast as one
// of 64.
std::int64_t thousandth(std::int64_t value) {
  const auto amount = static_cast<std::uint64_t>(value < 0 ? -value : value);
  const auto upper = static_cast<std::uint32_t>(amount >> 16U);
  const auto lower = static_cast<std::uint32_t>(amount & 0xFFFFU);
  const std::uint32_t high = upper / 1000U;
  const std::uint32_t low = (((upper - 1000U * high) << 16U) | lower) / 1000U;
  const auto whole = static_cast<std::int32_t>((high << 16U) + low);
  return value < 0 ? -whole : whole;
}

// Direction of an angle within +-pi/4. The angle is split into a part that a float holds exactly and a remainder below
// 2^-24 rad. The remainder enters by the first derivative: rounding the angle itself would cost as much as everything
// else.
SinCos sincos_of_octant(std::int64_t picoradians) {
  // Units of 2^-32 rad: 2^62 / 1e9 = 4611686018.4, and |nanoradians| < 2^30 keeps the product inside 63 bits.
  const std::int64_t units = (thousandth(picoradians) * 4'611'686'018) >> 30;
  constexpr float kPerHigh = 1.0F / 16'777'216.0F;
  constexpr float kPerLow = kPerHigh / 256.0F;
  const float high = static_cast<float>(static_cast<std::int32_t>(units >> 8)) * kPerHigh;
  const float low = static_cast<float>(static_cast<std::int32_t>(units & 255)) * kPerLow;
  const float q = high * high;
  const float s = sine_tail(high, q);
  const float c = cosine_tail(q);
  return {1.0F + (c - low * high), high + (s + (low + low * c))};
}

// Taylor series to x^15 on [0, tan(pi/8)]: truncation below 2e-8.
float atan_small(float x) {
  const float q = x * x;
  float sum = 7.69230769e-2F - q * 6.66666667e-2F;
  sum = -9.09090909e-2F + q * sum;
  sum = 1.11111111e-1F + q * sum;
  sum = -1.42857143e-1F + q * sum;
  sum = 2.0e-1F + q * sum;
  sum = -3.33333333e-1F + q * sum;
  return x * (1.0F + q * sum);
}

constexpr float kTanPi8 = 0.414213562F;

// atan on [0, 1], by the identity atan(x) = pi/4 - atan((1-x)/(1+x)) above tan(pi/8).
float atan_unit(float x) {
  if (x <= kTanPi8) return atan_small(x);
  return 0.25F * kPi - atan_small((1.0F - x) / (1.0F + x));
}

}  // namespace

SinCos sincos_urad(std::int64_t microradians) {
  // Whole turns are subtracted first, in integers of 1 prad: 159 turns at 1000 rad cost less than 0.1 nrad.
  constexpr std::int64_t kNoOverflow = 9'000'000'000'000;
  if (microradians > kNoOverflow || microradians < -kNoOverflow) microradians %= 6'283'185;
  std::int64_t pico = microradians * 1'000'000;
  if (pico >= kTwoPiPicoradians || pico <= -kTwoPiPicoradians) pico %= kTwoPiPicoradians;
  if (pico < 0) pico += kTwoPiPicoradians;
  // Nearest quarter turn, and the remainder within +-pi/4: four comparisons are cheaper than a 64-bit division.
  unsigned quarter = 0;
  for (; pico >= kHalfPiPicoradians / 2; pico -= kHalfPiPicoradians) ++quarter;
  const SinCos rest = sincos_of_octant(pico);
  switch (quarter & 3U) {
    case 0: return {rest.cos, rest.sin};
    case 1: return {-rest.sin, rest.cos};
    case 2: return {-rest.cos, -rest.sin};
    default: return {rest.sin, -rest.cos};
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
