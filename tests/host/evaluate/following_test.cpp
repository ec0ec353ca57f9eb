#include "host/evaluate/following.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

constexpr std::nullopt_t kFalse = std::nullopt;

/// One frame with one blob, which object `id` takes.
void see(Following& following, std::uint32_t id, std::optional<std::size_t> owner) {
  const PlacedSighting sighting{id, 1, 0};
  following.add({owner}, {&sighting, 1});
}

TEST(Following, AnObjectThatStaysWithItsOwnHasNoSwap) {
  Following following;
  for (int i = 0; i < 5; ++i) see(following, 7, 2);
  EXPECT_EQ(following.swaps(7), 0U);
  EXPECT_EQ(following.follows(7), 2U);
  EXPECT_EQ(following.visible(2), 5U);
  EXPECT_EQ(following.visible(0), 0U);
}

// A A B B A: from A to B and back.
TEST(Following, EachChangeOfTheTrueObjectIsASwap) {
  Following following;
  for (const std::size_t owner : {0U, 0U, 1U, 1U, 0U}) see(following, 1, owner);
  EXPECT_EQ(following.swaps(1), 2U);
  EXPECT_EQ(following.follows(1), 0U);
}

// A - A - B with false blobs between: one change.
TEST(Following, AFalseBlobIsNoOnes) {
  Following following;
  see(following, 1, 0);
  see(following, 1, kFalse);
  see(following, 1, 0);
  see(following, 1, kFalse);
  see(following, 1, 1);
  EXPECT_EQ(following.swaps(1), 1U);
  EXPECT_EQ(following.visible(0), 2U);
  see(following, 2, kFalse);
  EXPECT_EQ(following.follows(2), std::nullopt);
  EXPECT_EQ(following.swaps(2), 0U);
}

// Two objects that cross: each changes its true object once. A blob nobody took is still visible.
TEST(Following, TwoThatCrossSwapOnceEach) {
  Following following;
  const std::vector<PlacedSighting> straight{{1, 1, 0}, {2, 1, 1}};
  const std::vector<PlacedSighting> crossed{{1, 2, 1}, {2, 2, 0}};
  following.add({0, 1, 2}, straight);
  following.add({0, 1, 2}, crossed);
  EXPECT_EQ(following.swaps(1), 1U);
  EXPECT_EQ(following.swaps(2), 1U);
  EXPECT_EQ(following.swaps(), 2U);
  EXPECT_EQ(following.visible(2), 2U);
  following.clear();
  EXPECT_EQ(following.swaps(), 0U);
  EXPECT_EQ(following.visible(2), 0U);
}

// Two pieces of one object in a frame: visible once.
TEST(Following, AFrameCountsOnce) {
  Following following;
  following.add({3, 3}, {});
  EXPECT_EQ(following.visible(3), 1U);
}

}  // namespace
}  // namespace fencepost::host
