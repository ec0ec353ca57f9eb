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

// Packets 41 and 42: of the right wheel and of the left one.
TEST(EmulatedCreate, TellsWhatWasRequested) {
  CreateDevice one(CreateModel::kOne, false);
  (void)one.feed(test::hex_text("80 83"));
  one.request(90, 100);
  EXPECT_EQ(one.feed(test::hex_text("95 02 29 2A")), test::hex_text("00 64 00 5A"));
  (void)one.feed(test::hex_text("91 FF 38 00 C8"));
  one.request(90, 100);
  EXPECT_EQ(one.feed(test::hex_text("95 02 29 2A")), test::hex_text("FF 38 00 C8")) << "whoever drives it";
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

/// After `start` and `command`, so long.
CreateDevice driven(const char* command, double seconds, const char* start = "80 83") {
  CreateDevice two(CreateModel::kTwo, true);
  (void)two.feed(test::hex_text(start));
  (void)two.feed(test::hex_text(command));
  two.drive_on(seconds);
  return two;
}

std::string counts_of(CreateDevice device) { return device.feed(test::hex_text("95 02 2B 2C")); }

// 508.8 counts are 226.195 mm: 200 mm are 449.87 counts, 0x01C1 whole ones.
TEST(EmulatedCreate, DrivesAsItIsTold) {
  EXPECT_EQ(counts_of(driven("89 00 C8 7F FF", 1)), test::hex_text("01 C1 01 C1"));
  EXPECT_EQ(counts_of(driven("89 00 C8 80 00", 1)), test::hex_text("01 C1 01 C1")) << "straight has two names";
  EXPECT_EQ(counts_of(driven("89 00 C8 00 01", 1)), test::hex_text("FE 3F 01 C1")) << "on the spot, to the left";
  EXPECT_EQ(counts_of(driven("89 00 C8 FF FF", 1)), test::hex_text("01 C1 FE 3F"));
  EXPECT_EQ(counts_of(driven("91 00 00 00 C8", 1)), test::hex_text("01 C1 00 00")) << "direct: right first";
  // 200 mm/s on 500 mm: 153 and 247 mm/s, 344.2 and 555.6 counts.
  EXPECT_EQ(counts_of(driven("89 00 C8 01 F4", 1)), test::hex_text("01 58 02 2B"));
  EXPECT_EQ(driven("89 7F FF 7F FF", 0).speeds(), (CreateDevice::Speeds{500, 500})) << "clipped";
}

TEST(EmulatedCreate, DrivesInSafeAndFullOnly) {
  EXPECT_EQ(driven("89 00 C8 7F FF", 1, "80").speeds(), CreateDevice::Speeds());
  EXPECT_FALSE(driven("89 00 C8 7F FF", 1, "80").driven());
  CreateDevice safe = driven("89 00 C8 7F FF", 1);
  safe.lift();
  EXPECT_EQ(safe.mode(), 1);
  EXPECT_EQ(safe.speeds(), CreateDevice::Speeds());
  CreateDevice full = driven("89 00 C8 7F FF", 1, "80 84");
  full.lift();
  EXPECT_EQ(full.speeds().left, 200) << "full knows no mercy";
  (void)full.feed(test::hex_text("80"));
  EXPECT_EQ(full.speeds(), CreateDevice::Speeds()) << "Start ends it";
}

TEST(EmulatedCreate, ItsMotionIsWhatItReports) {
  CreateDevice one(CreateModel::kOne, false);
  (void)one.feed(test::hex_text("80 83 89 00 C8 7F FF"));
  for (int i = 0; i < 10; ++i) one.drive_on(0.015);
  EXPECT_EQ(one.feed(test::hex_text("95 02 13 14")), test::hex_text("00 1E 00 00")) << "30 mm straight on";
  (void)one.feed(test::hex_text("89 00 C8 00 01"));
  one.drive_on(1);  // 400 mm/s between wheels 258 mm apart: 88.8 degrees
  EXPECT_EQ(one.feed(test::hex_text("95 02 13 14")), test::hex_text("00 00 00 58"));
}

}  // namespace
}  // namespace fencepost::emulate
