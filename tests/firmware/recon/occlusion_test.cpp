#include "firmware/recon/occlusion.hpp"

#include <gtest/gtest.h>

#include <array>

namespace fencepost::test {
namespace {

using recon::HiddenEnds;
using recon::WaitingBlob;

constexpr std::int16_t kRows = 208;

HiddenEnds ends_of_first(const WaitingBlob& first, const WaitingBlob& second) {
  const std::array<WaitingBlob, 2> blobs{first, second};
  return recon::hidden_ends(blobs, 0, kRows);
}

const WaitingBlob kFar{{100, 80, 140, 120}, 1};

TEST(Occlusion, ANearerNeighbourHidesTheTouchingEnd) {
  const HiddenEnds right = ends_of_first(kFar, {{141, 70, 180, 150}, 2});
  EXPECT_FALSE(right.left);
  EXPECT_TRUE(right.right);
  const HiddenEnds left = ends_of_first(kFar, {{60, 70, 99, 150}, 2});
  EXPECT_TRUE(left.left);
  EXPECT_FALSE(left.right);
}

TEST(Occlusion, AFartherNeighbourHidesNothing) {
  const HiddenEnds ends = ends_of_first(kFar, {{141, 70, 180, 110}, 2});
  EXPECT_FALSE(ends.left);
  EXPECT_FALSE(ends.right);
}

TEST(Occlusion, EqualRowsDoNotTellSoTheEndIsNotUsed) {
  EXPECT_TRUE(ends_of_first(kFar, {{141, 70, 180, 121}, 2}).right);
}

TEST(Occlusion, ABottomBelowTheImageIsNearer) {
  const WaitingBlob box{{100, 80, 140, 205}, 1};
  EXPECT_TRUE(ends_of_first(box, {{141, 70, 180, 207}, 2}).right);
  EXPECT_FALSE(ends_of_first({{141, 70, 180, 207}, 2}, box).left);
}

TEST(Occlusion, ANeighbourThatDoesNotTouchHidesNothing) {
  EXPECT_FALSE(ends_of_first(kFar, {{146, 70, 180, 150}, 2}).right);
  EXPECT_TRUE(ends_of_first(kFar, {{145, 70, 180, 150}, 2}).right);
}

TEST(Occlusion, ALowerNeighbourHidesTheBottomButNoSide) {
  const HiddenEnds ends = ends_of_first(kFar, {{130, 110, 180, 150}, 2});
  EXPECT_FALSE(ends.right);
  EXPECT_TRUE(ends.bottom);
}

}  // namespace
}  // namespace fencepost::test
