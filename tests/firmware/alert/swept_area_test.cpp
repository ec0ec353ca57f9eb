#include "firmware/alert/swept_area.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace fencepost::test {
namespace {

using alert::RobotPath;
using alert::SweptArea;

RobotPath path_of(float forward, float turn, float half_width = 0.15F) {
  RobotPath path;
  path.motion = {forward, turn};
  path.half_width = half_width;
  return path;
}

TEST(SweptArea, IsTheStripAhead) {
  const SweptArea area(path_of(0.2F, 0), 0.03F);
  EXPECT_TRUE(area.contains(300, 0));
  EXPECT_TRUE(area.contains(300, 120));
  EXPECT_TRUE(area.contains(300, -120));
  EXPECT_FALSE(area.contains(300, 121));
  EXPECT_FALSE(area.contains(300, -121));
  EXPECT_FALSE(area.contains(-300, 0));
}

TEST(SweptArea, OfARobotThatReversesIsBehind) {
  const SweptArea area(path_of(-0.2F, 0), 0.03F);
  EXPECT_TRUE(area.contains(-300, 100));
  EXPECT_FALSE(area.contains(300, 100));
}

// Odometry that wavers does not tell whether it stands or backs off: what is ahead still counts.
TEST(SweptArea, OfARobotThatHardlyMovesIsOnBothSides) {
  const SweptArea area(path_of(-0.04F, 0.06F), 0);
  EXPECT_TRUE(area.contains(300, 100));
  EXPECT_TRUE(area.contains(-300, 100));
  EXPECT_FALSE(SweptArea(path_of(0.04F, 0.06F), 0).contains(-300, 100));
}

// A slow arc counts besides the way straight on.
TEST(SweptArea, OfARobotThatCreepsRoundABendIsBothWays) {
  const SweptArea area(path_of(0.05F, 0.2F, 0.1F), 0);  // 0.25 m to the left
  EXPECT_TRUE(area.contains(250, 0));
  EXPECT_TRUE(area.contains(250, 250));
}

TEST(SweptArea, OfARobotThatStandsIsAhead) {
  for (const float turn : {0.0F, 1.0F}) EXPECT_TRUE(SweptArea(path_of(0, turn), 0).contains(300, 100));
}

// An arc of 0.5 m to the left, half width 0.12 m: half a metre on it is at (0.42, 0.23).
TEST(SweptArea, FollowsTheArc) {
  const SweptArea left(path_of(0.25F, 0.5F), 0.03F);
  EXPECT_TRUE(left.contains(421, 230));
  EXPECT_TRUE(left.contains(421 + 84, 230 - 54));
  EXPECT_FALSE(left.contains(421, 0));
  EXPECT_FALSE(left.contains(421, -230));
  const SweptArea right(path_of(0.25F, -0.5F), 0.03F);
  EXPECT_TRUE(right.contains(421, -230));
  EXPECT_FALSE(right.contains(421, 230));
  const SweptArea back(path_of(-0.25F, -0.5F), 0.03F);  // its pivot is to the left, too
  EXPECT_TRUE(back.contains(-421, 230));
  EXPECT_FALSE(back.contains(-421, -230));
}

// The same as distances from the pivot say, for all radii and places within reach.
TEST(SweptArea, IsWhatTheDistanceFromThePivotSays) {
  for (const float radius : {0.16F, 0.3F, 1.0F, 5.0F, 49.0F}) {
    for (const float half_width : {0.05F, 0.15F, 0.6F, 2.5F}) {
      const SweptArea area(path_of(0.5F, 0.5F / radius, half_width), 0);
      const double pivot = 1000 * double{radius}, half = 1000 * double{half_width};
      for (int x = 50; x <= 3950; x += 130) {
        for (int y = -3950; y <= 3950; y += 130) {
          const double off = std::fabs(std::hypot(x, y - pivot) - pivot) - half;
          if (std::fabs(off) < 2) continue;  // rounding
          EXPECT_EQ(area.contains(x, y), off < 0) << radius << " " << half_width << " " << x << " " << y;
        }
      }
    }
  }
}

// Points of a front are 64 mm apart.
TEST(SweptArea, IsNeverNarrowerThanTheGuardsPointsAreApart) {
  const SweptArea area(path_of(0.2F, 0, 0.02F), 0.03F);
  EXPECT_TRUE(area.contains(300, 32));
  EXPECT_FALSE(area.contains(300, 33));
}

}  // namespace
}  // namespace fencepost::test
