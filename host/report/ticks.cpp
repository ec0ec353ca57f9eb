#include "host/report/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {

double nice_step(double least) {
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (digit * power >= least * (1 - 1e-9)) return digit * power;
  }
  return 10 * power;
}

int step_decimals(double step) { return std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9))); }

std::vector<double> ticks(double low, double high, double step) {
  std::vector<double> at;
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high / step + 1e-9));
  for (long long i = first; i <= last; ++i) at.push_back(static_cast<double>(i) * step);
  return at;
}

}  // namespace fencepost::host
