// Our own exponential, for the same reason as our own trigonometry: the same bits on every target.
#pragma once

namespace fencepost::base {

/// exp(-x) for x >= 0; 0 from kExpUnderflow on. Relative error at most 4e-6. Only + - * and a table.
float exp_minus(float x);

/// exp(-24) is below 4e-11.
inline constexpr float kExpUnderflow = 24.0F;

}  // namespace fencepost::base
