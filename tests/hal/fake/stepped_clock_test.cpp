#include "hal/fake/stepped_clock.hpp"

#include <gtest/gtest.h>

namespace fencepost::fake {
namespace {

TEST(SteppedClock, MovesOnlyWhenTold) {
  SteppedClock clock(base::Time{100});
  EXPECT_EQ(clock.now(), base::Time{100});
  EXPECT_EQ(clock.now(), base::Time{100});
  clock.advance(base::milliseconds(2));
  EXPECT_EQ(clock.now(), base::Time{120});
}

}  // namespace
}  // namespace fencepost::fake
