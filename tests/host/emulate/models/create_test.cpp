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

// All packets, 7 to 58, in 80 bytes, as a host asks that takes them for a struct: mode at 40, counts at 52.
TEST(EmulatedCreate, TellsAllPacketsAtOnce) {
  CreateDevice two(CreateModel::kTwo, true);
  (void)two.feed(test::hex_text("80 83"));
  two.roll(1'000, 65'500);
  const std::string all = two.feed(test::hex_text("8E 64"));
  ASSERT_EQ(all.size(), 80U);
  EXPECT_EQ(all.substr(17, 9), test::hex_text("3E 80 FE D4 19 0A 28 0A 88")) << "16 V, -300 mA, 25 C, 2600 of 2696 mAh";
  EXPECT_EQ(all[40], '\x02');
  EXPECT_EQ(all.substr(52, 4), test::hex_text("03 E8 FF DC"));
  EXPECT_EQ(two.feed(test::hex_text("8E 65")), all.substr(52)) << "packets 43 to 58";
  const std::pair<int, std::size_t> sizes[] = {{0, 26}, {1, 10}, {2, 6},    {3, 10}, {4, 14},
                                               {5, 12}, {6, 52}, {106, 12}, {107, 9}};
  for (const auto& [group, size] : sizes) {
    EXPECT_EQ(two.feed(std::string{'\x8E', static_cast<char>(group)}).size(), size) << group;
  }
  EXPECT_TRUE(two.not_emulated().empty());
}

// As if its battery was taken out: off, the stream ended.
TEST(EmulatedCreate, ResetsAndCountsWhatIsNoOpcode) {
  CreateDevice two(CreateModel::kTwo, true);
  (void)two.feed(test::hex_text("80 83 94 01 07"));
  EXPECT_TRUE(two.streaming());
  (void)two.feed(test::hex_text("07"));
  EXPECT_FALSE(two.streaming());
  EXPECT_EQ(two.mode(), 0);
  EXPECT_EQ(two.feed(test::hex_text("8E 23")), "") << "before a start";
  (void)two.feed(test::hex_text("7F"));
  EXPECT_EQ(two.not_emulated(), (std::vector<std::string>{"boot message", "bytes below 128 that are no opcode"}));
  CreateDevice one(CreateModel::kOne, true);
  (void)one.feed(test::hex_text("80 07"));
  EXPECT_EQ(one.mode(), 1) << "which has no reset";
}

// A host that counts the bytes of a frame takes no frame that lacks a packet. Its lists, without and with wheel counts.
TEST(EmulatedCreate, StreamsEveryPacketAskedFor) {
  CreateDevice one(CreateModel::kOne, true);
  (void)one.feed(test::hex_text("80 94 14 07 08 09 0A 0B 0C 0D 0E 0F 11 12 13 14 15 16 17 18 19 1A 23"));
  EXPECT_EQ(one.frame(),
            test::hex_text("13 2E 07 00 08 00 09 00 0A 00 0B 00 0C 00 0D 00 0E 00 0F 00 11 00 12 00 13 00 00 14 00 00 "
                           "15 00 16 3E 80 17 FE D4 18 19 19 0A 28 1A 0A 88 23 01 F4"));
  CreateDevice two(CreateModel::kTwo, true);
  (void)two.feed(
      test::hex_text("80 94 1E 07 08 09 0A 0B 0C 0D 0E 0F 11 12 15 16 17 18 19 1A 23 2B 2C 2D 2E 2F 30 31 32 "
                     "33 34 35 3A"));
  const std::string frame = two.frame();
  ASSERT_EQ(frame.size(), 75U);
  EXPECT_EQ(frame[1], 72);
  unsigned sum = 0;
  for (const char byte : frame) sum += static_cast<unsigned char>(byte);
  EXPECT_EQ(sum % 256, 0U) << "header included";
  EXPECT_TRUE(two.not_emulated().empty());
}

// Arguments that are opcodes themselves: 148 is a stream, 255 its length.
TEST(EmulatedCreate, KnowsTheArgumentsOfWhatItDoesNotDo) {
  constexpr const char* kCommands[] = {
      "92 FF 94 FF 9C",        // PWM of -108 and -100
      "8A 94",                 // motors
      "8B 94 94 94",           // LEDs
      "8C 01 02 94 94 94 94",  // song of two notes
      "8C 00 00",              // an empty one
      "8D 94",                 // play
      "90 94 94 94",           // PWM of the motors
      "A2 94 94",              // scheduling LEDs
      "A3 94 94 94 94",        // digits
      "A4 94 94 94 94",
      "A5 94",  // buttons
      "A7 94 94 94 94 94 94 94 94 94 94 94 94 94 94 94",
      "A8 94 94 94",
      "81 94",  // baud
  };
  for (const char* command : kCommands) {
    CreateDevice two(CreateModel::kTwo, true);
    (void)two.feed(test::hex_text("80 83"));
    EXPECT_EQ(two.feed(test::hex_text(command)), "") << command;
    EXPECT_EQ(two.feed(test::hex_text("8E 23")), test::hex_text("02")) << command;
    EXPECT_FALSE(two.streaming()) << command;
    EXPECT_TRUE(two.not_emulated().empty()) << command;
  }
  CreateDevice one(CreateModel::kOne, true);
  (void)one.feed(test::hex_text("80 83 98 03 94 94 94 9C 94 94 9E 94 93 94 97 94"));
  EXPECT_EQ(one.feed(test::hex_text("8E 23")), test::hex_text("02")) << "script, waits, outputs, infrared";
  EXPECT_TRUE(one.not_emulated().empty());
  (void)one.feed(test::hex_text("A6 AB 8E 2B"));
  EXPECT_EQ(one.not_emulated(), (std::vector<std::string>{"opcode 166", "opcode 171", "packet 43"}));
}

TEST(EmulatedCreate, DrivesByPwmAndStops) {
  CreateDevice two = driven("92 FF 94 FF 9C", 0);  // right -108, left -100 of 255, which are 500 mm/s
  EXPECT_EQ(two.speeds(), (CreateDevice::Speeds{-196, -211}));
  EXPECT_EQ(two.feed(test::hex_text("95 01 27")), test::hex_text("FF 35")) << "their mean, -203";
  EXPECT_EQ(driven("89 00 C8 01 F4", 0).feed(test::hex_text("95 02 27 28")), test::hex_text("00 C8 01 F4"));
  (void)two.feed(test::hex_text("94 01 2B"));
  (void)two.feed(test::hex_text("AD"));
  EXPECT_EQ(two.mode(), 0) << "stop is off";
  EXPECT_EQ(two.frame(), "");
  EXPECT_EQ(two.speeds(), CreateDevice::Speeds());
  (void)two.feed(test::hex_text("80 84 8F 8E 23"));
  EXPECT_EQ(two.mode(), 1) << "docking is passive";
}

}  // namespace
}  // namespace fencepost::emulate
