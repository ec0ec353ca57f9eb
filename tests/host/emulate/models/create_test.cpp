#include "host/emulate/models/create.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

TEST(EmulatedCreate, StreamsUnderEitherRule) {
  CreateDevice without(CreateModel::kTwo, false);
  CreateDevice with(CreateModel::kTwo, true);
  for (CreateDevice* device : {&without, &with}) {
    (void)device->feed(test::hex_text("80 94 02 2B 2C"));
    device->roll(1'000, 65'500);
  }
  EXPECT_EQ(without.frame(), test::hex_text("13 06 2B 03 E8 2C FF DC DD"));
  EXPECT_EQ(with.frame(), test::hex_text("13 06 2B 03 E8 2C FF DC CA"));
  (void)with.feed(test::hex_text("94 02 1D 0D"));
  EXPECT_EQ(with.frame(), test::hex_text("13 05 1D 02 19 0D 00 A3"));
  (void)with.feed(test::hex_text("96 00"));
  EXPECT_EQ(with.frame(), "");
  (void)with.feed(test::hex_text("96 01"));
  EXPECT_NE(with.frame(), "");
}

TEST(EmulatedCreate, ReadingDistanceAndAngleResetsThem) {
  CreateDevice one(CreateModel::kOne, false);
  (void)one.feed(test::hex_text("80 94 02 13 14"));
  one.move(25.9, -3.2);
  EXPECT_EQ(one.frame(), test::hex_text("13 06 13 00 19 14 FF FD BE"));
  EXPECT_EQ(one.frame(), test::hex_text("13 06 13 00 00 14 00 00 D3")) << "the fractions are gone too";
}

TEST(EmulatedCreate, DoesNothingBeforeStart) {
  CreateDevice two(CreateModel::kTwo, false);
  EXPECT_EQ(two.feed(test::hex_text("94 02 2B 2C 8E 2B")), "");
  EXPECT_EQ(two.frame(), "");
  EXPECT_EQ(two.feed(test::hex_text("80 83 8E 23")), test::hex_text("02"));
  EXPECT_EQ(two.feed(test::hex_text("91 00 84 00 84 95 02 23 2B")), test::hex_text("02 00 00"))
      << "132 as an argument is no mode";
  EXPECT_EQ(two.power_up(), "");
  EXPECT_EQ(two.mode(), 0);
}

}  // namespace
}  // namespace fencepost::emulate
