// Byte for byte what the protocols' documents print, traps included.
#include "host/emulate/models/cmucam.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

// The worked example in 1-based coordinates: 11 x 21 pixels, 40..50, 60..80.
const std::vector<ColouredSpot> kOneBased = {{100, 30, 30, 39, 59, 49, 79, 116}};
// The worked example in 0-based coordinates: 10 x 20 pixels, 20..29, 40..59.
const std::vector<ColouredSpot> kZeroBased = {{100, 30, 30, 20, 40, 29, 59, 150}};
const std::vector<ColouredSpot> kNothing;  // no spot in view

TEST(EmulatedCmuCam, Versions) {
  CmuCamDevice one(CmuCamModel::kOne);
  EXPECT_EQ(one.power_up(), "CMUcam v1.12\r:");
  EXPECT_EQ(one.feed("GV\r"), test::hex_text("41 43 4B 0D 43 4D 55 63 61 6D 20 76 31 2E 31 32 0D 3A"));
  EXPECT_EQ(one.feed("rs\r"), "ACK\r\rCMUcam v1.12\r:");
  EXPECT_EQ(one.feed("\r"), ":");
  CmuCamDevice three(CmuCamModel::kThree);
  EXPECT_EQ(three.power_up(), "");
  EXPECT_EQ(three.finish_start(), "CMUcam2 v1.00 c6\r:");
  EXPECT_EQ(three.feed("GV\r"), test::hex_text("41 43 4B 0D 43 4D 55 63 61 6D 32 20 76 31 2E 30 30 20 63 36 3A"))
      << "no CR";
  EXPECT_EQ(three.feed("\r"), "ACK\r:");
  CmuCamDevice four(CmuCamModel::kFour);
  EXPECT_EQ(four.feed("GV\r"), "ACK\rCMUcam4 v1.02\r:");
}

// It starts for two seconds, deaf, after RS too.
TEST(EmulatedCmuCam, ACmucam4Starts) {
  CmuCamDevice four(CmuCamModel::kFour);
  EXPECT_EQ(four.power_up(), "");
  EXPECT_TRUE(four.starting());
  EXPECT_EQ(four.feed("\rRS\r"), "");
  EXPECT_EQ(four.finish_start(), "\rCMUcam4 v1.02\r:");
  EXPECT_EQ(four.feed("TC 0 255 0 255 0 255\r"), "ACK\r");
  EXPECT_EQ(four.feed("RS\rGV\r"), "ACK\r");
  EXPECT_TRUE(four.starting());
  EXPECT_EQ(four.frame(kOneBased), "");
  EXPECT_EQ(four.finish_start(), "\rCMUcam4 v1.02\r:");
  EXPECT_FALSE(four.starting());
}

TEST(EmulatedCmuCam, PacketsInBothForms) {
  CmuCamDevice one(CmuCamModel::kOne);
  EXPECT_EQ(one.feed("TC 90 130 16 40 16 40\r"), "ACK\r");
  // (116 + 4) / 8 = 15; 116 * 256 / 231 = 128.
  EXPECT_EQ(one.frame(kOneBased), "M 45 70 40 60 50 80 15 128\r");
  EXPECT_EQ(one.frame(kNothing), "M 0 0 0 0 0 0 0 0\r") << "it streams on";
  EXPECT_EQ(one.feed("\r"), ":");
  EXPECT_EQ(one.frame(kOneBased), "");
  EXPECT_EQ(one.feed("PM 1\rRM 3\r"),
            "ACK\r:"
            ":")
      << "RM 3 leaves its own ACK out";
  EXPECT_EQ(one.feed("TC\r"), "");
  EXPECT_EQ(one.frame(kOneBased), test::hex_text("FF 4D 2D 46 28 3C 32 50 0F 80 3A"));
  EXPECT_EQ(one.frame(kOneBased), "") << "one packet a question";

  CmuCamDevice three(CmuCamModel::kThree);
  EXPECT_EQ(three.feed("PM 1\rTC 90 130 16 40 16 40\r"), "ACK\r:ACK\r");
  EXPECT_EQ(three.frame(kZeroBased), "T 24 49 20 40 29 59 150 255\r:");
  EXPECT_EQ(three.feed("RM 1\rTC\r"), "ACK\r:ACK\r");
  EXPECT_EQ(three.frame(kZeroBased), test::hex_text("FF 54 18 31 14 28 1D 3B 96 FE 3A"));
  EXPECT_EQ(three.feed("TC\r"), "ACK\r");
  EXPECT_EQ(three.frame(kNothing), test::hex_text("FF 54 00 00 00 00 00 00 00 00 3A"));

  CmuCamDevice four(CmuCamModel::kFour);
  EXPECT_EQ(four.feed("PM 1\rTC 90 130 16 40 16 40\r"), "ACK\r:ACK\r");
  const std::vector<ColouredSpot> spot = {{100, 30, 30, 70, 45, 89, 74, 600}};
  EXPECT_EQ(four.frame(spot), "T 79 59 70 45 89 74 7 255\r:");
}

TEST(EmulatedCmuCam, OneBoxOverAllThatMatches) {
  CmuCamDevice three(CmuCamModel::kThree);
  (void)three.feed("TC 90 130 16 40 16 40\r");
  const std::vector<ColouredSpot> spots = {
      {100, 30, 30, 10, 10, 19, 19, 100}, {100, 30, 30, 40, 40, 49, 49, 100}, {200, 30, 30, 70, 0, 79, 9, 100}};
  EXPECT_EQ(three.frame(spots), "T 29 29 10 10 49 49 200 131\r");
}

TEST(EmulatedCmuCam, RefusesWhatItDoesNotKnow) {
  CmuCamDevice three(CmuCamModel::kThree);
  for (const char* line : {"XX\r", "GV 1\r", "PM\r", "PM 1 2\r", "TC 1 2 3\r", "PM -1\r", "PM 0x1\r", "AG 0\r"}) {
    EXPECT_EQ(three.feed(line), "NCK\r:") << line;
  }
  EXPECT_EQ(three.feed(std::string(127, 'x')), "NCK\r:");
  EXPECT_EQ(three.feed("GV\n\r").substr(0, 4), "ACK\r") << "LF is garbage";
  EXPECT_EQ(three.feed("TC 90 80 16 40 16 40\r"), "ACK\r:");
  EXPECT_EQ(three.frame(kZeroBased), "") << "mute on swapped bounds";
}

TEST(EmulatedCmuCam, TheTrapsOfRawInput) {
  CmuCamDevice one(CmuCamModel::kOne);
  (void)one.feed("RM 4\r");
  EXPECT_EQ(one.feed(test::hex_text("54 43 06 5A 82 10 28 10 28")), "ACK\r");
  EXPECT_EQ(one.feed("RS\r"), "") << "CR is a count: 13 arguments follow";
  EXPECT_EQ(one.feed("GV\rGV\rGV\r"), "") << "9 of them";
  EXPECT_EQ(one.feed("\r\r\r\r"), "NCK\r:");
  EXPECT_EQ(one.feed(std::string("RS\0", 3)), "ACK\r\rCMUcam v1.12\r:");
  EXPECT_EQ(one.feed("GV\r"), "ACK\rCMUcam v1.12\r:") << "ASCII again";
  CmuCamDevice three(CmuCamModel::kThree);
  (void)three.feed("RM 4\r");
  EXPECT_EQ(three.feed("RS\r"), "NCK\r:") << "more than 10";
  // 100..110 arrive as 68..78: the spot of red 100 is not among them.
  EXPECT_EQ(three.feed(test::hex_text("54 43 06 64 6E 10 28 10 28")), "ACK\r");
  EXPECT_EQ(three.frame(kZeroBased), "T 0 0 0 0 0 0 0 0\r");
}

// A host seeks the baud rate, resets, and goes to the fastest rate. It sends three zeros and a CR before each attempt.
// The answer to BM comes without ':', then a CR at the new rate, then the stop bits.
TEST(EmulatedCmuCam, ACmucam4ChangesItsBaudRate) {
  CmuCamDevice four(CmuCamModel::kFour);
  (void)four.power_up();
  (void)four.finish_start();
  EXPECT_EQ(four.feed(test::hex_text("00 00 00 0D 52 53 0D")), "ACK\r:ACK\r");
  EXPECT_EQ(four.feed(test::hex_text("00 00 00 0D 52 53 0D")), "") << "starting";
  EXPECT_EQ(four.finish_start(), "\rCMUcam4 v1.02\r:");
  EXPECT_EQ(four.feed("BM 100\r"), "NCK\r:");
  EXPECT_EQ(four.baud(), 0U);
  EXPECT_EQ(four.feed("BM 250000\r"), "ACK\r");
  EXPECT_EQ(four.baud(), 250'000U);
  EXPECT_EQ(four.feed("\r"), "ACK\r:");
  EXPECT_EQ(four.feed("DM 0\r"), "ACK\r:");
  EXPECT_EQ(four.feed(test::hex_text("00 00 00 0D") + "GV\r"), "ACK\r:ACK\rCMUcam4 v1.02\r:") << "before each command";
  EXPECT_EQ(four.feed("AX\bG\t1\r"), "ACK\r:") << "backspace and tab";
  EXPECT_EQ(four.feed("\x80\xFF\x7F\r"), "ACK\r:");
  (void)four.power_up();
  EXPECT_EQ(four.baud(), 0U) << "a start forgets it";
  EXPECT_TRUE(four.not_emulated().empty());
}

TEST(EmulatedCmuCam, ACmucam4TellsItsBoundsAndAcceptsWhatItDoesNotDo) {
  CmuCamDevice four(CmuCamModel::kFour);
  (void)four.feed("ST 90 130 16 40 16 40\r");
  EXPECT_EQ(four.feed("GT\r"), "ACK\r90 130 16 40 16 40\r:");
  EXPECT_EQ(four.feed("GW\r"), "ACK\r0 0 159 119\r:");
  EXPECT_EQ(four.feed("SW 10 20 30 40\rGW\r"), "ACK\r:ACK\r10 20 30 40\r:");
  EXPECT_EQ(four.feed("SW\rGW\r"), "ACK\r:ACK\r0 0 159 119\r:");
  EXPECT_EQ(four.feed("L1 5\rSS 0 1 1500\rL1\rGM\r"), "ACK\r:ACK\r:NCK\r:NCK\r:");
  EXPECT_EQ(four.not_emulated(), (std::vector<std::string>{"L1", "SS", "GM"}));
  CmuCamDevice three(CmuCamModel::kThree);
  EXPECT_EQ(three.feed("BM 250000\r\x05\r"), "NCK\r:NCK\r:") << "of a CMUcam4 only";
  EXPECT_EQ(three.not_emulated(), (std::vector<std::string>{"BM", "unreadable bytes"}));
}

}  // namespace
}  // namespace fencepost::emulate
