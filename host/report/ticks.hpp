// Round numbers for axes.
#pragma once

#include <vector>

namespace fencepost::host {

/// The smallest of 1, 2, 5 x 10^n that is at least `least` (> 0).
double nice_step(double least);

/// Decimals needed to write multiples of `step`.
int step_decimals(double step);

/// Multiples of `step` in [low, high].
std::vector<double> ticks(double low, double high, double step);

}  // namespace fencepost::host
