#include "host/smooth/par.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace fencepost::host {
namespace {

// A quarter turn brings (1, 0) to (0, 1); shifted by (2, 3) to (2, 4).
TEST(Alignment, FindsAQuarterTurnAndAShift) {
  const std::array<PointPair, 3> pairs = {{{{0, 0}, {2, 3}}, {{1, 0}, {2, 4}}, {{0, 2}, {0, 3}}}};
  const FloorMotion motion = aligned(pairs);
  EXPECT_NEAR(motion.turn, std::acos(0.0), 1e-12);
  EXPECT_NEAR(motion.shift.x, 2, 1e-12);
  EXPECT_NEAR(motion.shift.y, 3, 1e-12);
  EXPECT_NEAR(rms_of(distances_after(motion, pairs)), 0, 1e-12);
}

// Two points 2 m apart and their images 4 m apart: no rigid motion does better than 1 m at each.
TEST(Alignment, DoesNotStretch) {
  const std::array<PointPair, 2> pairs = {{{{-1, 0}, {-2, 5}}, {{1, 0}, {2, 5}}}};
  EXPECT_NEAR(rms_of(distances_after(aligned(pairs), pairs)), 1, 1e-12);
}

TEST(Alignment, OfOnePairIsAShift) {
  const std::array<PointPair, 1> pairs = {{{{1, 1}, {3, 0}}}};
  const FloorMotion motion = aligned(pairs);
  EXPECT_EQ(motion.turn, 0);
  EXPECT_NEAR(rms_of(distances_after(motion, pairs)), 0, 1e-12);
  EXPECT_EQ(rms_of(distances_after(aligned({}), {})), 0);
}

}  // namespace
}  // namespace fencepost::host
