// Golden bytes of the protocol's description, from the device's side.
#include "host/emulate/models/nxt.hpp"

#include <gtest/gtest.h>

#include "host/emulate/models/nxtcam.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kReady{100'000};

TEST(EmulatedNxt, AnswersAsDocumented) {
  NxtBrick brick(base::Time{});
  brick.turn(1, 1234);
  EXPECT_FALSE(brick.telegram(hex("01 88"), base::Time{20'000}));
  EXPECT_EQ(brick.telegram(hex("01 88"), kReady), hex("02 88 00 7C 01 1D 01"));
  EXPECT_EQ(brick.telegram(hex("00 0B"), kReady), hex("02 0B 00 78 1E"));
  EXPECT_EQ(brick.telegram(hex("00 0D"), kReady), hex("02 0D 00 C0 27 09 00"));
  EXPECT_FALSE(brick.telegram(hex("80 0D"), kReady));
  EXPECT_EQ(brick.telegram(hex("00 06 01"), kReady),
            hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 D2 04 00 00 D2 04 00 00 D2 04 00 00"));
  EXPECT_EQ(brick.telegram(hex("00 06 03"), kReady)->at(2), 0xC0);
  EXPECT_EQ(brick.telegram(hex("00 77"), kReady), hex("02 77 BE"));
}

TEST(EmulatedNxt, ReadsASensorAsDocumented) {
  NxtCam camera(base::Time{});
  NxtBrick brick(base::Time{});
  brick.attach(0, &camera);
  EXPECT_EQ(brick.telegram(hex("00 0F 00 02 0B 02 42"), kReady), hex("02 0F E0"));
  EXPECT_EQ(brick.telegram(hex("00 05 00 0B 00"), kReady), hex("02 05 00"));
  EXPECT_EQ(brick.telegram(hex("00 0F 00 03 00 02 41 45"), kReady), hex("02 0F 00"));
  const sensor::Blob second{2, 60, 40, 81, 70, {}, {}, 0, {}};
  const sensor::Blob fifth{5, 100, 100, 121, 130, {}, {}, 0, {}};
  camera.show({second, fifth});
  const base::Time later = kReady + base::milliseconds(30);
  EXPECT_EQ(brick.telegram(hex("00 0F 00 02 0B 02 42"), later), hex("02 0F 00"));
  EXPECT_EQ(brick.telegram(hex("00 0E 00"), later), hex("02 0E 20 00"));
  const base::Time done = later + base::milliseconds(30);
  EXPECT_EQ(brick.telegram(hex("00 0E 00"), done), hex("02 0E 00 0B"));
  EXPECT_EQ(brick.telegram(hex("00 10 00"), done), hex("02 10 00 0B 02 02 3C 28 50 46 05 64 64 78 82 00 00 00 00 00"));
  EXPECT_EQ(brick.telegram(hex("00 0E 07"), done), hex("02 0E C0"));
  brick.attach(1, nullptr);
  EXPECT_TRUE(brick.telegram(hex("00 05 01 0B 00"), done));
  EXPECT_TRUE(brick.telegram(hex("00 0F 01 02 0B 02 42"), done));
  EXPECT_EQ(brick.telegram(hex("00 0E 01"), done + base::milliseconds(30)), hex("02 0E DD 00"));
}

TEST(EmulatedNxt, FallsAsleep) {
  NxtBrick brick(base::Time{});
  brick.set_sleep_time(base::milliseconds(60'000));
  EXPECT_TRUE(brick.telegram(hex("00 0D"), base::Time{500'000}));
  EXPECT_TRUE(brick.telegram(hex("00 0B"), base::Time{1'099'000}));
  EXPECT_FALSE(brick.telegram(hex("00 0B"), base::Time{1'101'000}));
}

TEST(EmulatedNxt, FramesForBluetooth) {
  NxtBrick brick(base::Time{});
  std::vector<std::uint8_t> answer;
  for (const std::uint8_t byte : hex("02 00 00 0B")) answer = brick.take(byte, kReady);
  EXPECT_EQ(answer, hex("05 00 02 0B 00 78 1E"));
}

TEST(EmulatedNxt, TellsItsNameAndResetsPositions) {
  NxtBrick brick(base::Time{});
  brick.turn(1, 1234);
  EXPECT_EQ(brick.telegram(hex("01 9B"), kReady),
            hex("02 9B 00 4E 58 54 00 00 00 00 00 00 00 00 00 00 00 00 00 16 53 00 00 01 00 00 00 00 00 00 00 01 00"));
  EXPECT_EQ(brick.telegram(hex("00 0A 01 01"), kReady), hex("02 0A 00"));
  brick.turn(1, 1235);
  EXPECT_EQ(brick.telegram(hex("00 06 01"), kReady),
            hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 D3 04 00 00 01 00 00 00 D3 04 00 00"))
      << "relative";
  EXPECT_EQ(brick.telegram(hex("00 0A 01 00"), kReady), hex("02 0A 00"));
  EXPECT_EQ(brick.telegram(hex("00 06 01"), kReady),
            hex("02 06 00 01 4B 07 01 00 20 00 00 00 00 D3 04 00 00 01 00 00 00 00 00 00 00"))
      << "absolute";
  EXPECT_EQ(brick.telegram(hex("00 0A 03 00"), kReady), hex("02 0A C0"));
  EXPECT_TRUE(brick.not_emulated().empty());
  EXPECT_EQ(brick.telegram(hex("01 77"), kReady), hex("02 77 BE"));
  EXPECT_EQ(brick.not_emulated(), std::vector<std::string>{"0x01 0x77"});
}

}  // namespace
}  // namespace fencepost::emulate
