#include "firmware/recon/localize/strayers.hpp"

#include <gtest/gtest.h>

namespace fencepost::test {
namespace {

using recon::Strayers;

constexpr float kMost = recon::kMostSurprise;

int sightings_until_barred(Strayers<4>& strayers, std::size_t slot, std::uint8_t signature, float surprise) {
  for (int n = 1; n <= 1000; ++n) {
    if (strayers.look(slot, signature, surprise)) return n;
  }
  return 0;
}

// 9 (1 - (15/16)^n) exceeds 4 with the tenth.
TEST(Strayers, WhatIsNeverWhereItShouldBeIsNoLandmark) {
  Strayers<4> strayers;
  EXPECT_EQ(sightings_until_barred(strayers, 2, 7, kMost), 10);
  EXPECT_TRUE(strayers.bars(2, 7));
  EXPECT_FALSE(strayers.bars(1, 7)) << "another object of its colour may stand";
  strayers.forget(2);
  EXPECT_FALSE(strayers.bars(2, 7));
}

TEST(Strayers, WhatIsAsFarOffAsExpectedStays) {
  Strayers<4> strayers;
  EXPECT_EQ(sightings_until_barred(strayers, 0, 7, 1.5F), 0);
  for (int jump = 0; jump < 5; ++jump) EXPECT_FALSE(strayers.look(0, 7, kMost)) << "the pose was off";
  EXPECT_FALSE(strayers.bars(0, 7));
}

TEST(Strayers, TwoOfASignatureSpeakForAll) {
  Strayers<4> strayers;
  sightings_until_barred(strayers, 0, 7, kMost);
  sightings_until_barred(strayers, 1, 7, kMost);
  EXPECT_TRUE(strayers.bars(3, 7));
  EXPECT_FALSE(strayers.bars(3, 8));
  strayers.clear();
  EXPECT_FALSE(strayers.bars(3, 7));
}

}  // namespace
}  // namespace fencepost::test
