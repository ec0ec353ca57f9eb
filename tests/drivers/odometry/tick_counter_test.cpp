#include "drivers/odometry/tick_counter.hpp"

#include <gtest/gtest.h>

namespace fencepost::odometry {
namespace {

constexpr base::Time tick_at(std::int64_t ms) { return {ms * 10}; }

TEST(TickCounter, CountsFromItsFirstReading) {
  TickCounter counter(32, 1'000);
  EXPECT_EQ(counter.step(500, tick_at(0)), std::nullopt);
  EXPECT_EQ(counter.step(507, tick_at(20)), 7);
  EXPECT_EQ(counter.step(502, tick_at(40)), -5);
  EXPECT_EQ(counter.step(502, tick_at(60)), 0);
}

TEST(TickCounter, WrapsAtItsWidthEitherWay) {
  struct Row {
    int bits;
    std::uint32_t before, after;
    std::int32_t counts;
  };
  constexpr Row kRows[] = {
      {16, 65'530, 4, 10},
      {16, 4, 65'530, -10},
      {16, 32'760, 32'775, 15},
      {24, 0xFF'FFFF, 1, 2},
      {24, 1, 0xFF'FFFF, -2},
      {32, 0xFFFF'FFFE, 3, 5},
      {32, 3, 0xFFFF'FFFE, -5},
      {8, 250, 5, 11},
      // A device that sends 16 bits sign-extended: the upper half does not matter.
      {16, 0x0000'7FFF, 0xFFFF'8001, 2},
  };
  for (const Row& row : kRows) {
    TickCounter counter(row.bits, 200);
    EXPECT_FALSE(counter.step(row.before, tick_at(0)));
    EXPECT_EQ(counter.step(row.after, tick_at(20)), row.counts) << row.bits << " bits from " << row.before;
  }
}

TEST(TickCounter, TakesAnImpossibleStepAsAReset) {
  TickCounter counter(32, 1'000);  // 120 ms at 1000 a second, plus one: 121
  EXPECT_FALSE(counter.step(100'000, tick_at(0)));
  EXPECT_EQ(counter.step(100'121, tick_at(20)), 121);
  EXPECT_EQ(counter.step(100'243, tick_at(40)), std::nullopt) << "122 in 20 ms";
  EXPECT_EQ(counter.step(100'250, tick_at(60)), 7) << "goes on from the reading that was refused";
  EXPECT_EQ(counter.step(0, tick_at(80)), std::nullopt) << "the device was switched off and on";
  EXPECT_EQ(counter.step(3, tick_at(100)), 3);
}

TEST(TickCounter, TakesAnImpossibleStepBackAsAResetToo) {
  TickCounter counter(32, 1'000);
  EXPECT_FALSE(counter.step(100'000, tick_at(0)));
  EXPECT_EQ(counter.step(99'879, tick_at(20)), -121);
  EXPECT_EQ(counter.step(99'757, tick_at(40)), std::nullopt);
}

// Of two bits, the half range is 2, and a count is always possible.
TEST(TickCounter, HasTwoBitsAtLeast) {
  TickCounter counter(2, 1);
  EXPECT_FALSE(counter.step(3, tick_at(0)));
  EXPECT_EQ(counter.step(0, tick_at(20)), 1);
  EXPECT_EQ(counter.step(3, tick_at(40)), -1);
  EXPECT_EQ(counter.step(0, tick_at(939)), 1);
  EXPECT_EQ(counter.step(1, tick_at(1'839)), std::nullopt)
      << "two counts in 0.9 s and its lateness: they may have wrapped";
}

TEST(TickCounter, AnHourOfSilenceAtMost) {
  TickCounter counter(32, 1'000);
  EXPECT_FALSE(counter.step(0, tick_at(0)));
  EXPECT_EQ(counter.step(5, base::Time{36'000'000}), 5);
  EXPECT_EQ(counter.step(10, base::Time{72'000'001}), std::nullopt);
}

TEST(TickCounter, ALongerWaitAllowsMoreUntilTheWrapIsAmbiguous) {
  TickCounter counter(16, 1'000);  // half the range is reached after 32.8 s
  EXPECT_FALSE(counter.step(0, tick_at(0)));
  EXPECT_EQ(counter.step(20'000, tick_at(30'000)), 20'000);
  EXPECT_EQ(counter.step(20'000, tick_at(62'000)), 0);
  EXPECT_EQ(counter.step(20'001, tick_at(95'000)), std::nullopt) << "33 s";
}

TEST(TickCounter, TimeThatStandsStillOrRunsBackTellsNothing) {
  TickCounter counter(32, 1'000);
  EXPECT_FALSE(counter.step(0, tick_at(20)));
  EXPECT_FALSE(counter.step(1, tick_at(20)));
  EXPECT_FALSE(counter.step(2, tick_at(10)));
  EXPECT_EQ(counter.step(3, tick_at(30)), 1);
  EXPECT_FALSE(counter.step(4, base::Time{INT64_MAX / 2})) << "and no overflow";
}

TEST(TickCounter, ForgetsOnRequest) {
  TickCounter counter(32, 1'000);
  EXPECT_FALSE(counter.step(10, tick_at(0)));
  counter.forget();
  EXPECT_FALSE(counter.step(11, tick_at(20)));
  EXPECT_EQ(counter.step(12, tick_at(40)), 1);
}

}  // namespace
}  // namespace fencepost::odometry
