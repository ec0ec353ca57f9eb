#include "hal/base/units.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fencepost::base {
namespace {

// Halves that a double holds exactly: 0.03125 m = 312.5 tenths of a millimetre.
TEST(Units, RoundsHalfAwayFromZero) {
  struct Row {
    double metres;
    std::int32_t raw;
  };
  for (const Row& row : {Row{0.0, 0}, Row{0.00004, 0}, Row{0.00006, 1}, Row{0.03125, 313}, Row{-0.03125, -313},
                         Row{0.03124, 312}, Row{-0.03124, -312}, Row{0.09375, 938}, Row{-0.09375, -938},
                         Row{1.0, 10'000}, Row{-1000.0, -10'000'000}, Row{999.9999, 9'999'999}}) {
    EXPECT_EQ(Metres::nearest(row.metres).raw, row.raw) << row.metres;
  }
  EXPECT_EQ(Pixels1::nearest(0.25).raw, 3);
  EXPECT_EQ(Pixels1::nearest(-0.25).raw, -3);
  EXPECT_EQ(Pixels2::nearest(157.5).raw, 15'750);
  EXPECT_EQ(Ratio2::nearest(0.125).raw, 13);
  EXPECT_EQ(Duration::nearest(-0.03125).raw, -313);
  EXPECT_EQ(Time::nearest(999'999.0).raw, 9'999'990'000);
}

// 0.5 - 2^-54 is the double just below a half: adding a half to it gives 1.0.
TEST(Units, RoundsTheNumberJustBelowAHalfDown) {
  using Whole = Scaled<MetreUnit, 0>;
  EXPECT_EQ(Whole::nearest(std::nextafter(0.5, 0.0)).raw, 0);
  EXPECT_EQ(Whole::nearest(std::nextafter(-0.5, 0.0)).raw, 0);
  EXPECT_EQ(Whole::nearest(0.5).raw, 1);
  EXPECT_EQ(Whole::nearest(-0.5).raw, -1);
}

TEST(Units, SurvivesTheWayThroughDouble) {
  for (std::int32_t raw = -10'000'000; raw <= 10'000'000; raw += 997) {
    EXPECT_EQ(Metres::nearest(Metres{raw}.to_double()).raw, raw);
  }
}

TEST(Units, FloatsAreTheNearestOfTheDecimal) {
  for (std::int32_t raw = -16'777'215; raw <= 16'777'215; raw += 9'973) {
    EXPECT_EQ(Metres{raw}.to_float(), static_cast<float>(Metres{raw}.to_double())) << raw;
  }
}

TEST(Units, TimesDifferByDurations) {
  const Time start{12'345};
  const Time end = start + milliseconds(50);
  EXPECT_EQ((end - start).raw, 500);
  EXPECT_EQ(end - milliseconds(50), start);
  EXPECT_LT(start, end);
}

TEST(Units, CountDecimals) {
  EXPECT_EQ(Metres::kPerUnit, 10'000);
  EXPECT_EQ(Pixels1::kPerUnit, 10);
  EXPECT_EQ(Ratio2::kPerUnit, 100);
  static_assert(Metres::nearest(0.25) + Metres::nearest(0.5) == Metres::nearest(0.75));
  static_assert(-(Metres{3} - Metres{5}) == Metres{2});
}

}  // namespace
}  // namespace fencepost::base
