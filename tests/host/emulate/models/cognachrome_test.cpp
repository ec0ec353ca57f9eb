#include "host/emulate/models/cognachrome.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

Bytes text(std::string_view said) { return test::bytes_of(said); }

constexpr base::Time kCognachromeUp = base::Time{} + Cognachrome::kStart;

std::string say(Cognachrome& camera, const Bytes& bytes, base::Time now = kCognachromeUp) {
  std::string said;
  for (const std::uint8_t byte : bytes) {
    for (const std::uint8_t answered : camera.take(byte, now)) said += static_cast<char>(answered);
  }
  return said;
}
std::string say(Cognachrome& camera, std::string_view keys) { return say(camera, text(keys)); }

// At column 120, row 80, with 600 pixels.
const sensor::Blob kA{1, 110, 70, 129, 89, {}, {}, 600, {}};
const sensor::Blob kB{2, 30, 108, 35, 111, {}, {}, 45, {}};  // at column 33, row 110, with 45 pixels

TEST(CognachromeModel, SendsWhatItWasToldTo) {
  Cognachrome camera(Cognachrome::Preset::kVision, 0);
  camera.show({kB, kA});
  EXPECT_EQ(camera.step(kCognachromeUp), Bytes{}) << "it does not track yet";
  EXPECT_EQ(say(camera, hex("FE 03")), "");
  EXPECT_EQ(say(camera, "q"), "\xFE\x03\r\ntpuvis [a]> ");
  EXPECT_EQ(say(camera, "ph"), "\xFE\x03\r\nNew protocol header:");
  EXPECT_EQ(say(camera, "\\377\n"), "\xFE\x03\r\ntpuvis [a]> ");
  EXPECT_EQ(say(camera, "pb"), "\xFE\x03\r\nNew protocol chan B:");
  say(camera, "b%wC%wR%wN\npaa%wC%wR%wN\n");
  EXPECT_EQ(camera.strings()[1], "a%wC%wR%wN");
  EXPECT_EQ(say(camera, "ab"), "\xFE\x03\r\ntpuvis [b]> ");
  EXPECT_EQ(say(camera, "r"), "");
  EXPECT_TRUE(camera.in_use());
  EXPECT_EQ(camera.step(kCognachromeUp), hex("FF 61 00 78 00 50 02 5C 62 00 21 00 6E 00 2D"));
  camera.show({});
  EXPECT_EQ(camera.step(kCognachromeUp), hex("FF"));
  say(camera, "q");
  EXPECT_EQ(camera.step(kCognachromeUp), Bytes{});
}

TEST(CognachromeModel, HearsOnlyItsStreamAndForgetsWithoutPower) {
  Cognachrome camera(Cognachrome::Preset::kVision, 0);
  EXPECT_EQ(say(camera, "q"), "") << "stream 0 is the monitor's";
  EXPECT_EQ(say(camera, hex("FE 03 71"), base::Time{} + base::milliseconds(999)), "");
  say(camera, hex("FE 03 70 68 78 0A"));
  EXPECT_EQ(camera.strings()[0], "x");
  static_cast<void>(camera.power_up(kCognachromeUp));
  EXPECT_EQ(camera.strings()[0], "");
}

TEST(CognachromeModel, SendsTeamBotsStream) {
  Cognachrome camera(Cognachrome::Preset::kTeamBots, 0);
  camera.show({kA, kB});
  EXPECT_EQ(camera.step(kCognachromeUp), text("$00#18:78:50:00&07:21:6E:00"));
  EXPECT_EQ(camera.step(kCognachromeUp).at(2), '1');
}

TEST(CognachromeModel, IsDescribed) {
  EXPECT_EQ(describe_cognachrome(false, hex("FF 61 00 78 00 50 02 5C")), "1 object");
  EXPECT_EQ(describe_cognachrome(true, hex("FE 03 71")), "\"\\xFE\\x03q\"");
}

}  // namespace
}  // namespace fencepost::emulate
