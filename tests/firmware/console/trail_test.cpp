#include "firmware/console/trail.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace fencepost::test {
namespace {

constexpr std::size_t kMax = 32;
using Trail = console::Trail<kMax>;

TEST(Trail, HoldsEvenlySpacedPlacesOfTheWholeRun) {
  Trail trail;
  for (std::int32_t x = 0; x <= 100'000; x += 10) trail.push({x, -x / 2});
  const auto places = trail.places();
  ASSERT_GE(places.size(), kMax / 2);
  EXPECT_EQ(places.front().x, 0) << "where it began";
  const int step = places[1].x - places[0].x;
  for (std::size_t i = 1; i < places.size(); ++i) EXPECT_NEAR(places[i].x - places[i - 1].x, step, 2) << i;
  // The end is no farther from the last place than one step.
  EXPECT_LE(100'000 / console::TrailPlace::kUnit - places.back().x, step);
  EXPECT_NEAR(places.back().y, -places.back().x / 2, 1);
}

TEST(Trail, ARobotThatStandsLeavesOnePlace) {
  Trail trail;
  for (int i = 0; i < 1000; ++i) trail.push({500 + i % 3, 500});
  EXPECT_EQ(trail.places().size(), 1U);
}

TEST(Trail, TheEdgeOfTheWorldIsHeld) {
  Trail trail;
  trail.push({0, 0});
  trail.push({INT32_MAX, INT32_MIN + 1});
  ASSERT_EQ(trail.places().size(), 2U);
  EXPECT_EQ(trail.places()[1].x, INT16_MAX);
  EXPECT_EQ(trail.places()[1].y, -INT16_MAX);
}

}  // namespace
}  // namespace fencepost::test
