#include "drivers/nxtcam/registers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/drivers/hex.hpp"

namespace fencepost::nxtcam {
namespace {

using test::hex;

std::vector<std::uint8_t> text(std::string text) {
  text.resize(16, '\0');
  return {text.begin(), text.end()};
}

// "colour 2 at (60,40)-(80,70); colour 5 at (100,100)-(120,130)"; the last columns are doubled ones.
TEST(NxtCamRegisters, DocumentedObjects) {
  const sensor::Blob second{2, 60, 40, 81, 70, {705}, {550}, 0, {}};
  const sensor::Blob fifth{5, 100, 100, 121, 130, {1105}, {1150}, 0, {}};
  EXPECT_EQ(object_in(hex("02 3C 28 50 46")), second);
  EXPECT_EQ(object_in(hex("05 64 64 78 82")), fifth);
}

TEST(NxtCamRegisters, OddColumnsAreSingleOnes) {
  EXPECT_EQ(object_in(hex("00 0A 00 0B 00"))->x2, 11);
  EXPECT_EQ(object_in(hex("00 0B 00 0C 00"))->x2, 12);
  EXPECT_EQ(object_in(hex("00 0A 00 0C 00"))->x2, 13);
}

TEST(NxtCamRegisters, TheBorderBelongsToTheImage) {
  const auto blob = object_in(hex("07 AE 8F B0 90"));  // (174,143)-(176,144)
  ASSERT_TRUE(blob);
  EXPECT_EQ(blob->x2, 175);
  EXPECT_EQ(blob->y2, 143);
}

TEST(NxtCamRegisters, ImpossibleObjectsAreNone) {
  EXPECT_FALSE(object_in(hex("08 00 00 0A 0A")));  // colour
  EXPECT_FALSE(object_in(hex("00 0C 00 0A 0A")));  // left of right
  EXPECT_FALSE(object_in(hex("00 00 0B 0A 0A")));  // top of bottom
  EXPECT_FALSE(object_in(hex("00 00 00 B1 0A")));
  EXPECT_FALSE(object_in(hex("00 00 00 0A 91")));
  EXPECT_FALSE(object_in(hex("00 00 00 0A")));
}

TEST(NxtCamRegisters, AnyNxtCamIsOne) {
  EXPECT_TRUE(is_nxtcam(text("mndsnsrsNXTCam")));
  EXPECT_TRUE(is_nxtcam(text("mndsnsrsNXTCam5")));
  EXPECT_FALSE(is_nxtcam(text("mndsnsrsDIST-L")));
  EXPECT_FALSE(is_nxtcam(text("LEGO")));
  EXPECT_FALSE(is_nxtcam(hex("6D 6E")));
}

TEST(NxtCamRegisters, AColourNeedsAllThreeChannels) {
  std::array<std::uint8_t, 48> map{};
  EXPECT_EQ(taught_colours(map), 0);
  map[3] = 0x05;
  map[16 + 4] = 0x04;
  map[16 + 5] = 0x01;
  EXPECT_EQ(taught_colours(map), 0);
  map[32 + 9] = 0x04;
  EXPECT_EQ(taught_colours(map), 0x04);
  EXPECT_EQ(taught_colours(std::span<const std::uint8_t>(map).first(47)), 0);
}

}  // namespace
}  // namespace fencepost::nxtcam
