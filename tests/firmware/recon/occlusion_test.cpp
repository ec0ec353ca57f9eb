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

TEST(Occlusion, PiecesBehindAPostAreJoined) {
  base::FixedVector<WaitingBlob, sensor::kMaxBlobs> blobs;
  ASSERT_TRUE(blobs.push_back({{100, 80, 120, 120}, 1}));
  ASSERT_TRUE(blobs.push_back({{136, 81, 150, 119}, 1}));
  ASSERT_TRUE(blobs.push_back({{121, 60, 135, 170}, 2}));
  const recon::CutPair pair = recon::find_cut_pair(blobs.view(), 0, 0);
  ASSERT_TRUE(pair.found);
  recon::join(blobs, pair);
  ASSERT_EQ(blobs.size(), 2U);
  EXPECT_EQ(blobs[0].box.x1, 100);
  EXPECT_EQ(blobs[0].box.x2, 150);
  EXPECT_EQ(blobs[0].box.y1, 80);
  EXPECT_EQ(blobs[0].box.y2, 120);
  EXPECT_FALSE(recon::hidden_ends(blobs.view(), 0, kRows).left);
  EXPECT_FALSE(recon::hidden_ends(blobs.view(), 0, kRows).right);
}

TEST(Occlusion, TwoObjectsWithNothingBetweenStayTwo) {
  for (const WaitingBlob& other : {WaitingBlob{{121, 60, 128, 170}, 2},      // does not fill the gap
                                   WaitingBlob{{121, 60, 135, 100}, 2},      // ends above them: it stands farther away
                                   WaitingBlob{{121, 100, 135, 170}, 2}}) {  // lower: both would show above it
    base::FixedVector<WaitingBlob, sensor::kMaxBlobs> blobs;
    ASSERT_TRUE(blobs.push_back({{100, 80, 120, 120}, 1}));
    ASSERT_TRUE(blobs.push_back({{140, 81, 160, 119}, 1}));
    ASSERT_TRUE(blobs.push_back(other));
    EXPECT_FALSE(recon::find_cut_pair(blobs.view(), 0, 0).found);
  }
}

}  // namespace
}  // namespace fencepost::test
