#include "hal/base/fixed.hpp"

#include <gtest/gtest.h>

namespace fencepost::base {
namespace {

TEST(FixedVector, RefusesWhatDoesNotFit) {
  FixedVector<int, 3> items;
  EXPECT_TRUE(items.empty());
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(items.push_back(i));
  EXPECT_TRUE(items.full());
  EXPECT_FALSE(items.push_back(3));
  EXPECT_EQ(items.size(), 3U);
  EXPECT_EQ(items[2], 2);
}

TEST(FixedVector, TakesAgainAfterRoomWasMade) {
  FixedVector<int, 1> items;
  EXPECT_TRUE(items.push_back(1));
  items.pop_back();
  EXPECT_TRUE(items.push_back(2));
  EXPECT_EQ(items[0], 2);
}

TEST(FixedVector, ErasesInOrder) {
  FixedVector<int, 4> items;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(items.push_back(i));
  items.erase_at(1);
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(items[0], 0);
  EXPECT_EQ(items[1], 2);
  EXPECT_EQ(items[2], 3);
  items.erase_at(2);
  items.truncate(1);
  EXPECT_EQ(items.view().size(), 1U);
  EXPECT_EQ(*items.begin(), 0);
}

TEST(FixedVector, ComparesOnlyWhatItHolds) {
  FixedVector<int, 2> a;
  FixedVector<int, 2> b;
  EXPECT_TRUE(a.push_back(1));
  EXPECT_TRUE(a.push_back(9));
  a.pop_back();
  EXPECT_TRUE(b.push_back(1));
  EXPECT_EQ(a, b);
  EXPECT_TRUE(b.push_back(2));
  EXPECT_NE(a, b);
}

TEST(FixedVectorDeath, TrapsOutsideItsSize) {
  FixedVector<int, 2> items;
  EXPECT_DEATH(static_cast<void>(items[0]), "");
  EXPECT_DEATH(items.pop_back(), "");
  EXPECT_DEATH(items.erase_at(0), "");
  EXPECT_DEATH(items.truncate(1), "");
}

TEST(Ring, IsAQueueAcrossItsSeam) {
  Ring<int, 3> ring;
  for (int i = 0; i < 20; ++i) {
    if (ring.full()) {
      EXPECT_EQ(ring.front(), i - 3);
      ring.pop_front();
    }
    EXPECT_TRUE(ring.push_back(i));
    EXPECT_EQ(ring.back(), i);
  }
  EXPECT_EQ(ring[0], 17);
  EXPECT_EQ(ring[1], 18);
  EXPECT_EQ(ring[2], 19);
}

TEST(Ring, RefusesWhatDoesNotFit) {
  Ring<int, 2> ring;
  EXPECT_TRUE(ring.push_back(1));
  EXPECT_TRUE(ring.push_back(2));
  EXPECT_FALSE(ring.push_back(3));
  EXPECT_EQ(ring.front(), 1);
  EXPECT_EQ(ring.size(), 2U);
}

TEST(Ring, PushesOverTheOldestOnDemand) {
  Ring<int, 2> ring;
  for (int i = 1; i <= 5; ++i) ring.push_over_oldest(i);
  EXPECT_EQ(ring.front(), 4);
  EXPECT_EQ(ring.back(), 5);
  ring.clear();
  EXPECT_TRUE(ring.empty());
}

TEST(RingDeath, TrapsOutsideItsSize) {
  Ring<int, 2> ring;
  EXPECT_DEATH(ring.pop_front(), "");
  EXPECT_DEATH(static_cast<void>(ring.front()), "");
  EXPECT_DEATH(static_cast<void>(ring.back()), "");
}

TEST(FixedString, CutsWhatDoesNotFit) {
  EXPECT_EQ(FixedString<4>("abcdef").view(), "abcd");
  EXPECT_EQ(FixedString<4>("abcd").view(), "abcd");
  EXPECT_TRUE(FixedString<4>("").empty());
}

TEST(FixedString, RefusesACharacterTooMany) {
  FixedString<2> text;
  EXPECT_TRUE(text.push_back('a'));
  EXPECT_TRUE(text.push_back('b'));
  EXPECT_FALSE(text.push_back('c'));
  EXPECT_EQ(text.view(), "ab");
}

TEST(FixedString, ComparesItsText) {
  EXPECT_EQ(FixedString<8>("red"), FixedString<8>("red"));
  EXPECT_NE(FixedString<8>("red"), FixedString<8>("redder"));
}

TEST(SlotsInUse, EndWithTheLastOne) {
  struct Slot {
    bool taken;
    [[nodiscard]] bool used() const { return taken; }
  };
  using Slots = std::array<Slot, 4>;
  EXPECT_EQ(slots_in_use(Slots{}), 0U);
  EXPECT_EQ(slots_in_use(Slots{{{true}, {false}, {false}, {false}}}), 1U);
  EXPECT_EQ(slots_in_use(Slots{{{false}, {false}, {true}, {false}}}), 3U);
  EXPECT_EQ(slots_in_use(Slots{{{true}, {false}, {false}, {true}}}), 4U);
}

}  // namespace
}  // namespace fencepost::base
