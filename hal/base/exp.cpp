#include "hal/base/exp.hpp"

#include <array>
#include <cstddef>

namespace fencepost::base {
namespace {

constexpr float kLog2E = 1.44269504F;
constexpr float kLn2 = 0.693147181F;

// 2^-n for every n that kExpUnderflow allows.
constexpr auto kPowers = [] {
  std::array<float, 36> powers{};
  float power = 1.0F;
  for (float& entry : powers) {
    entry = power;
    power *= 0.5F;
  }
  return powers;
}();
static_assert(kExpUnderflow * kLog2E + 0.5F < static_cast<float>(kPowers.size()));

}  // namespace

float exp_minus(float x) {
  if (!(x < kExpUnderflow)) return 0.0F;
  // x = (n - f) ln 2 with |f| <= 1/2, so exp(-x) = 2^-n exp(g), g = f ln 2: Taylor to g^6, truncation below 2e-7.
  const float halvings = x * kLog2E;
  const auto n = static_cast<std::size_t>(halvings + 0.5F);
  const float g = (static_cast<float>(n) - halvings) * kLn2;
  float sum = 8.33333333e-3F + g * 1.38888889e-3F;
  sum = 4.16666667e-2F + g * sum;
  sum = 1.66666667e-1F + g * sum;
  sum = 0.5F + g * sum;
  return kPowers[n] * (1.0F + g * (1.0F + g * sum));
}

}  // namespace fencepost::base
