// Our own exponential, for the same reason as our own trigonometry: the same bits on every target.
#pragma once

namespace fencepost::base {

/// exp(-x) for x >= 0; 0 from kExpUnderflow on. Relative error at most 4e-6. Only + - * and a table.
float exp_minus(float x);

/// exp(-24) is below 4e-11.
inline constexpr float kExpUnderflow = 24.0F;

inline constexpr float kExpLog2E = 1.44269504F;  ///< for this form and exp_minus_within()
inline constexpr float kExpLn2 = 0.693147181F;   ///< the same
/// exp(g) for |g| <= ln 2 / 2: Taylor to g^6, truncation below 2e-7.
inline float exp_of_rest(float g) {
  float sum = 8.33333333e-3F + g * 1.38888889e-3F;
  sum = 4.16666667e-2F + g * sum;
  sum = 1.66666667e-1F + g * sum;
  sum = 0.5F + g * sum;
  return 1.0F + g * (1.0F + g * sum);
}

}  // namespace fencepost::base
