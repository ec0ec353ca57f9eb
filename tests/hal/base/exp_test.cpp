#include "hal/base/exp.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fencepost::base {
namespace {

// The bound that exp.hpp promises; the reference is the C library's function in double.
TEST(ExpMinus, HoldsItsBound) {
  double worst = 0;
  for (int i = 0; i < 2'400'000; ++i) {
    const float x = static_cast<float>(i) * 1e-5F;
    const double exact = std::exp(-static_cast<double>(x));
    worst = std::max(worst, std::fabs(static_cast<double>(exp_minus(x)) - exact) / exact);
  }
  EXPECT_LE(worst, 4e-6);
  EXPECT_GT(worst, 1e-8);  // it was measured at all
}

TEST(ExpMinus, IsExactAtZeroAndNothingFarOut) {
  EXPECT_EQ(exp_minus(0), 1.0F);
  EXPECT_GT(exp_minus(23.99F), 0.0F);
  EXPECT_EQ(exp_minus(kExpUnderflow), 0.0F);
  EXPECT_EQ(exp_minus(1e30F), 0.0F);
  EXPECT_EQ(exp_minus(std::numeric_limits<float>::infinity()), 0.0F);
  EXPECT_EQ(exp_minus(std::numeric_limits<float>::quiet_NaN()), 0.0F);
}

// A weight that rises where the distance grows would turn robust fits around.
TEST(ExpMinus, NeverRisesByMoreThanRounding) {
  float before = 1;
  for (int i = 1; i < 240'000; ++i) {
    const float now = exp_minus(static_cast<float>(i) * 1e-4F);
    EXPECT_LE(now, before * (1 + 4e-6F)) << i;
    before = now;
  }
}

}  // namespace
}  // namespace fencepost::base
