// The median of a study's figures.
#pragma once

#include <algorithm>
#include <vector>

namespace fencepost::test {

/// The mean of the middle two; `values` must not be empty.
inline double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  return 0.5 * (values[values.size() / 2] + values[(values.size() - 1) / 2]);
}

}  // namespace fencepost::test
