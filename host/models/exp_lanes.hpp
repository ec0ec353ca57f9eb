// exp_minus() for loops that become vectors.
#pragma once

#include <cstdint>
#include <cstring>

#include "hal/base/exp.hpp"

namespace fencepost::base {

/// The bits of exp_minus() for 0 <= x <= kExpUnderflow without branches and without a table.
inline float exp_minus_within(float x) {
  const float halvings = x * kExpLog2E;
  const auto n = static_cast<std::int32_t>(halvings + 0.5F);
  constexpr std::int32_t kExponentOfOne = 127;
  const std::int32_t bits = (kExponentOfOne - n) * (1 << 23);  // of 2^-n
  float power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return power * exp_of_rest((static_cast<float>(n) - halvings) * kExpLn2);
}

}  // namespace fencepost::base
