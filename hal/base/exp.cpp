#include "hal/base/exp.hpp"

#include <array>
#include <cstddef>

namespace fencepost::base {
namespace {

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
static_assert(kExpUnderflow * kExpLog2E + 0.5F < static_cast<float>(kPowers.size()));

}  // namespace

float exp_minus(float x) {
  if (!(x < kExpUnderflow)) return 0.0F;
  // x = (n - f) ln 2 with |f| <= 1/2, so exp(-x) = 2^-n exp(g), g = f ln 2.
  const float halvings = x * kExpLog2E;
  const auto n = static_cast<std::size_t>(halvings + 0.5F);
  return kPowers[n] * exp_of_rest((static_cast<float>(n) - halvings) * kExpLn2);
}

}  // namespace fencepost::base
