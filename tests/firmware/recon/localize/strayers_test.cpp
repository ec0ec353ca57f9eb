#include "firmware/recon/localize/strayers.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::Strayers;

constexpr float kMax = recon::kMaxSurprise;

int sightings_until_barred(Strayers<4>& strayers, std::size_t slot, std::uint8_t signature, float surprise) {
  for (int n = 1; n <= 1000; ++n) {
    if (strayers.look(slot, signature, surprise)) return n;
  }
  return 0;
}

// 9 (1 - (15/16)^n) exceeds 4 with the tenth.
TEST(Strayers, WhatIsNeverWhereItShouldBeIsNoLandmark) {
  Strayers<4> strayers;
  EXPECT_EQ(sightings_until_barred(strayers, 2, 7, kMax), 10);
  EXPECT_TRUE(strayers.bars(2, 7));
  EXPECT_FALSE(strayers.bars(1, 7)) << "another object of its colour may stand";
  strayers.forget(2);
  EXPECT_FALSE(strayers.bars(2, 7));
}

TEST(Strayers, WhatIsAsFarOffAsExpectedStays) {
  Strayers<4> strayers;
  EXPECT_EQ(sightings_until_barred(strayers, 0, 7, 1.5F), 0);
  for (int jump = 0; jump < 5; ++jump) EXPECT_FALSE(strayers.look(0, 7, kMax)) << "the pose was off";
  EXPECT_FALSE(strayers.bars(0, 7));
}

TEST(Strayers, TwoOfASignatureSpeakForAll) {
  Strayers<4> strayers;
  sightings_until_barred(strayers, 0, 7, kMax);
  sightings_until_barred(strayers, 1, 7, kMax);
  EXPECT_TRUE(strayers.bars(3, 7));
  EXPECT_FALSE(strayers.bars(3, 8));
  strayers.clear();
  EXPECT_FALSE(strayers.bars(3, 7));
}

// One sighting of 64 makes the mean 4, which is not yet a stray's; anything more is.
TEST(Strayers, AMeanAtTheBoundIsNoStrayers) {
  Strayers<4> strayers;
  EXPECT_FALSE(strayers.look(0, 1, 64));
  EXPECT_EQ(strayers.mean(0), recon::kStraying);
  EXPECT_FALSE(strayers.bars(0, 1));
  EXPECT_TRUE(strayers.look(0, 1, 4.5F));
  EXPECT_EQ(strayers.mean(0), 2 * kMax);
  EXPECT_TRUE(strayers.bars(0, 1));
  EXPECT_FALSE(strayers.bars(1, 1)) << "one of that colour";
}

TEST(Strayers, OfFourSlotsAndThreeColours) {
  Draw draw(211);
  Sweep sweep;
  for (int run = 0; run < 100; ++run) {
    Strayers<4> strayers;
    for (int i = 0; i < 40; ++i) {
      const std::size_t slot = draw.between<std::size_t>(0, 3);
      const auto signature = draw.between<std::uint8_t>(1, 3);
      sweep.tell("strays", strayers.look(slot, signature, draw.of({0.0F, 9.0F, 64.0F, 72.0F})));
      sweep.tell("bars", strayers.bars(slot, signature));
      sweep.tell("mean", strayers.mean(slot));
      for (const std::uint8_t known : strayers.signatures()) sweep.tell("signature", known);
      if (draw.one_in(10)) strayers.forget(slot);
    }
    strayers.clear();
    sweep.tell("cleared", strayers.bars(0, 1));
  }
  expect_said(sweep, {"strays 2987 b78d6658", "bars 3255 5749df51", "mean 3742 46385157", "signature 13835 fbdaf9c2",
                      "cleared 0 f3600d4f"});
}

}  // namespace
}  // namespace fencepost::test
