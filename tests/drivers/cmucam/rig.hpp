// The bench of the CMUcam tests: two colours, two things.
#pragma once

#include "tests/drivers/bench/cmucam_rig.hpp"

namespace fencepost::cmucam {

using Rig = test::Bench<test::CmuCamRig>;

inline Config two_windows(const Dialect& dialect) {
  Config config = test::red_window(dialect);
  (void)config.windows.push_back({2, 16, 60, 16, 60, 180, 240});
  return config;
}

/// A red and a blue thing.
inline std::vector<emulate::ColouredSpot> red_and_blue() {
  return {{200, 30, 30, 20, 40, 29, 59, 150}, {30, 30, 200, 50, 60, 59, 89, 240}};
}

}  // namespace fencepost::cmucam
