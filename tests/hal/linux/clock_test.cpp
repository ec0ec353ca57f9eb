#include "hal/linux/clock.hpp"

#include <gtest/gtest.h>
#include <time.h>

namespace fencepost::linux {
namespace {

using base::milliseconds;

TEST(MonotonicClock, StartsAtZeroAndRunsForward) {
  const MonotonicClock clock;
  base::Time last = clock.now();
  EXPECT_GE(last, base::Time{});
  EXPECT_LT(last, base::Time{} + milliseconds(60'000));
  for (int i = 0; i < 1000; ++i) {
    const base::Time now = clock.now();
    EXPECT_GE(now, last);
    last = now;
  }
}

TEST(MonotonicClock, CountsTenthsOfMilliseconds) {
  const MonotonicClock clock;
  const base::Time before = clock.now();
  const timespec twenty{0, 20'000'000};
  ASSERT_EQ(::clock_nanosleep(CLOCK_MONOTONIC, 0, &twenty, nullptr), 0);
  EXPECT_GE(clock.now() - before, milliseconds(20) - base::Duration{1});
  EXPECT_LT(clock.now() - before, milliseconds(20'000));
}

TEST(MonotonicClock, CopiesShareTheirZero) {
  const MonotonicClock clock;
  const timespec five{0, 5'000'000};
  ASSERT_EQ(::clock_nanosleep(CLOCK_MONOTONIC, 0, &five, nullptr), 0);
  const MonotonicClock copy = clock;
  EXPECT_GE(copy.now(), base::Time{} + milliseconds(5) - base::Duration{1});
}

}  // namespace
}  // namespace fencepost::linux
