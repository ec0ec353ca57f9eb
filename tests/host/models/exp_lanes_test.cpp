#include "host/models/exp_lanes.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

namespace fencepost::base {
namespace {

// All that a weight can be: every float there is takes a minute, every 997th does not.
TEST(ExpMinus, IsTheSameInBothForms) {
  int compared = 0;
  for (std::uint32_t bits = 0;; bits += 997) {
    float x = 0;
    std::memcpy(&x, &bits, sizeof x);
    if (!(x < kExpUnderflow)) break;
    ASSERT_EQ(exp_minus_within(x), exp_minus(x)) << x;
    ++compared;
  }
  EXPECT_GT(compared, 1'000'000);
  for (float x = 0; x < kExpUnderflow; x += 1e-5F) ASSERT_EQ(exp_minus_within(x), exp_minus(x)) << x;
}

}  // namespace
}  // namespace fencepost::base
