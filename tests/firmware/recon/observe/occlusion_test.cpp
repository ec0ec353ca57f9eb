#include "firmware/recon/observe/occlusion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::Sides;
using recon::WaitingBlob;

constexpr std::int16_t kRows = 208;

Sides ends_of_first(const WaitingBlob& first, const WaitingBlob& second, int beside = recon::kTouchPixels) {
  const std::array<WaitingBlob, 2> blobs{first, second};
  return recon::hidden_sides(blobs, 0, kRows, beside);
}

const WaitingBlob kFar{{100, 80, 140, 120}, 1};

TEST(Occlusion, ANearerNeighbourHidesTheTouchingEnd) {
  const Sides right = ends_of_first(kFar, {{141, 70, 180, 150}, 2});
  EXPECT_FALSE(right.left);
  EXPECT_TRUE(right.right);
  const Sides left = ends_of_first(kFar, {{60, 70, 99, 150}, 2});
  EXPECT_TRUE(left.left);
  EXPECT_FALSE(left.right);
}

TEST(Occlusion, AFartherNeighbourHidesNothing) {
  const Sides ends = ends_of_first(kFar, {{141, 70, 180, 110}, 2});
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
  EXPECT_FALSE(ends_of_first(kFar, {{149, 70, 180, 150}, 2}, recon::kBesidePixels).right);
  EXPECT_TRUE(ends_of_first(kFar, {{148, 70, 180, 150}, 2}, recon::kBesidePixels).right);
}

TEST(Occlusion, TwoOfOneColourWithAGapBetweenWereNotMerged) {
  EXPECT_FALSE(ends_of_first(kFar, {{146, 70, 180, 150}, 1}, recon::kBesidePixels).right);
  EXPECT_TRUE(ends_of_first(kFar, {{145, 70, 180, 150}, 1}, recon::kBesidePixels).right);
}

TEST(Occlusion, ALowerNeighbourHidesTheBottomButNoSide) {
  const Sides ends = ends_of_first(kFar, {{115, 110, 180, 150}, 2});
  EXPECT_FALSE(ends.right);
  EXPECT_TRUE(ends.bottom);
}

// 20 of 41 columns are covered, or 21.
TEST(Occlusion, TheFootOfWhatIsSeenIsAFoot) {
  EXPECT_FALSE(ends_of_first(kFar, {{121, 110, 180, 150}, 2}).bottom);
  EXPECT_TRUE(ends_of_first(kFar, {{120, 110, 180, 150}, 2}).bottom);
}

TEST(Occlusion, AnEndNearTheBorderMayBeTheBorders) {
  EXPECT_TRUE(recon::near_border({4, 0, 90, 9}, 176).left);
  EXPECT_FALSE(recon::near_border({5, 0, 90, 9}, 176).left);
  EXPECT_TRUE(recon::near_border({50, 0, 171, 9}, 176).right);
  EXPECT_FALSE(recon::near_border({50, 0, 170, 9}, 176).right);
}

// Boxes that almost touch, in rows and columns, and at the image's lower end.
TEST(Occlusion, OfBoxesThatAlmostTouch) {
  Draw draw(21);
  Sweep sweep;
  for (int i = 0; i < 60'000; ++i) {
    const auto near = [&](int at, int off) { return static_cast<std::int16_t>(draw.between(at - off, at + off)); };
    std::vector<WaitingBlob> blobs;
    blobs.push_back({{100, near(80, 4), near(110, 3), near(200, 9)}, 1});
    for (int other = draw.between(1, 2); other > 0; --other) {
      const std::int16_t left = draw.of<std::int16_t>({90, 105, 112, 118, 96, 82});
      blobs.push_back({{near(left, 4), draw.coin() ? near(80, 8) : near(200, 9), near(left + draw.of({4, 10, 30}), 4),
                        near(200, 9)},
                       draw.one_in(3) ? std::uint8_t{1} : std::uint8_t{2}});
    }
    const int beside = draw.of({recon::kTouchPixels, recon::kBesidePixels});
    const Sides ends = recon::hidden_sides(blobs, 0, kRows, beside);
    sweep.tell("left", ends.left);
    sweep.tell("right", ends.right);
    sweep.tell("bottom", ends.bottom);
  }
  expect_said(sweep, {"left 7648 3f758a6c", "right 9970 5ad2d987", "bottom 8239 b8a9e4d0"});
}

TEST(Occlusion, NearTheBorderAreFiveColumnsAtEitherSide) {
  for (std::int16_t x1 = 0; x1 < 10; ++x1) {
    EXPECT_EQ(recon::near_border({x1, 50, 100, 60}, 316).left, x1 < 5) << x1;
    const auto x2 = static_cast<std::int16_t>(315 - x1);
    EXPECT_EQ(recon::near_border({100, 50, x2, 60}, 316).right, x2 >= 311) << x2;
  }
}

}  // namespace
}  // namespace fencepost::test
