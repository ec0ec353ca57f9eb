#include "hal/mcu/quadrature.hpp"

#include <gtest/gtest.h>

#include <array>
#include <utility>

namespace fencepost::mcu {
namespace {

// The levels of A and B in each quarter of a period, A ahead.
constexpr std::array<std::pair<bool, bool>, 4> kQuarters = {
    {{false, false}, {true, false}, {true, true}, {false, true}}};

void show(Quadrature& encoder, int quarter) {
  const auto [a, b] = kQuarters[static_cast<std::size_t>(quarter & 3)];
  encoder.feed(a, b);
}

TEST(Quadrature, CountsFourAPeriodUpAndDown) {
  Quadrature encoder;
  encoder.start(false, false);
  for (int quarter = 1; quarter <= 10; ++quarter) show(encoder, quarter);
  EXPECT_EQ(encoder.count(), 10U);
  for (int quarter = 9; quarter >= -3; --quarter) show(encoder, quarter);
  EXPECT_EQ(encoder.count(), static_cast<std::uint32_t>(-3));
}

TEST(Quadrature, StartsWhereTheWheelStands) {
  Quadrature encoder;
  encoder.start(true, true);
  encoder.feed(false, true);
  EXPECT_EQ(encoder.count(), 1U);
}

TEST(Quadrature, AnEdgeThatDidNotChangeAnythingCountsNothing) {
  Quadrature encoder;
  encoder.start(false, false);
  encoder.feed(false, false);  // down and up again before anybody looked
  EXPECT_EQ(encoder.count(), 0U);
}

TEST(Quadrature, AMissedEdgeIsCountedInTheDirectionOfTheLast) {
  Quadrature encoder;
  encoder.start(false, false);
  for (const int quarter : {1, 2, 3, 5}) show(encoder, quarter);
  EXPECT_EQ(encoder.count(), 5U);
  for (const int quarter : {4, 2}) show(encoder, quarter);
  EXPECT_EQ(encoder.count(), 2U);
}

}  // namespace
}  // namespace fencepost::mcu
