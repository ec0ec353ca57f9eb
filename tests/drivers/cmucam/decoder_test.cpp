#include "drivers/cmucam/decoder.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

namespace fencepost::cmucam {
namespace {

/// Everything a decoder says to some bytes, as text: "ACK", "text(...)", "prompt(...)", "T 1 2 ...@t". The byte with
/// index i arrives at 100 i.
std::vector<std::string> said(std::string_view bytes, Decoder decoder = {}) {
  std::vector<std::string> events;
  base::Time now{0};
  for (const char byte : bytes) {
    switch (decoder.feed(test::octet(byte), now)) {
      case Event::kNone: break;
      case Event::kAck: events.emplace_back("ACK"); break;
      case Event::kNck: events.emplace_back("NCK"); break;
      case Event::kPrompt: events.push_back("prompt(" + std::string(decoder.text()) + ")"); break;
      case Event::kText: events.push_back("text(" + std::string(decoder.text()) + ")"); break;
      case Event::kPacket: {
        const Packet& packet = decoder.packet();
        std::string event(1, packet.letter);
        for (std::size_t i = 0; i < packet.count; ++i) event += " " + std::to_string(packet.fields.at(i));
        events.push_back(event + "@" + std::to_string(packet.t.raw / 100));
      }
    }
    now.raw += 100;
  }
  return events;
}

using Said = std::vector<std::string>;

TEST(CmuCamDecoder, VersionOfACmuCam1) {
  const std::string bytes = test::hex_text("41 43 4B 0D 43 4D 55 63 61 6D 20 76 31 2E 31 32 0D 3A");
  EXPECT_EQ(said(bytes), (Said{"ACK", "text(CMUcam v1.12)", "prompt()"}));
}

TEST(CmuCamDecoder, VersionOfACmuCam3HasNoLineEnd) {
  const std::string bytes = test::hex_text("41 43 4B 0D 43 4D 55 63 61 6D 32 20 76 31 2E 30 30 20 63 36 3A");
  EXPECT_EQ(said(bytes), (Said{"ACK", "prompt(CMUcam2 v1.00 c6)"}));
}

TEST(CmuCamDecoder, ResetAndPowerUp) {
  EXPECT_EQ(said("ACK\r\rCMUcam v1.12\r:"), (Said{"ACK", "text(CMUcam v1.12)", "prompt()"}));
  EXPECT_EQ(said("CMUcam2 v1.00 c6\r:"), (Said{"text(CMUcam2 v1.00 c6)", "prompt()"}));
  EXPECT_EQ(said("\rCMUcam4 v1.02\r:"), (Said{"text(CMUcam4 v1.02)", "prompt()"}));
}

TEST(CmuCamDecoder, PacketsInAscii) {
  const std::string m =
      test::hex_text("4D 20 34 35 20 37 31 20 34 30 20 36 30 20 35 30 20 38 30 20 32 30 20 31 32 38 0D");
  EXPECT_EQ(m, "M 45 71 40 60 50 80 20 128\r");
  EXPECT_EQ(said(m), Said{"M 45 71 40 60 50 80 20 128@0"});
  EXPECT_EQ(said("T 45 71 40 60 50 80 20 181\r"), Said{"T 45 71 40 60 50 80 20 181@0"});
  EXPECT_EQ(said("T 24 49 20 40 29 59 150 255\r"), Said{"T 24 49 20 40 29 59 150 255@0"});
  EXPECT_EQ(said("T 80 60 70 45 89 74 7 255\r"), Said{"T 80 60 70 45 89 74 7 255@0"});
  EXPECT_EQ(said("C 40 60 50 80 20 128\r"), Said{"C 40 60 50 80 20 128@0"});
  EXPECT_EQ(said("N 128 45 71 40 60 50 80 20 128\r"), Said{"N 128 45 71 40 60 50 80 20 128@0"});
  EXPECT_EQ(said("S 90 40 41 3 4 5\r"), Said{"S 90 40 41 3 4 5@0"});
  EXPECT_EQ(said("S 1 2 3 4 5 6 7 8 9 10 11 12\r"), Said{"S 1 2 3 4 5 6 7 8 9 10 11 12@0"});
}

TEST(CmuCamDecoder, PacketsInRaw) {
  EXPECT_EQ(said(test::hex_text("FF 4D 2D 47 28 3C 32 50 14 80")), Said{"M 45 71 40 60 50 80 20 128@0"});
  EXPECT_EQ(said(test::hex_text("FF 43 28 3C 32 50 14 80")), Said{"C 40 60 50 80 20 128@0"});
  EXPECT_EQ(said(test::hex_text("FF 54 2D 47 28 3C 32 50 14 B5")), Said{"T 45 71 40 60 50 80 20 181@0"});
  EXPECT_EQ(said(test::hex_text("FF 54 18 31 14 28 1D 3B 96 FE")), Said{"T 24 49 20 40 29 59 150 254@0"});
  EXPECT_EQ(said(test::hex_text("FF 54 00 00 00 00 00 00 00 00")), Said{"T 0 0 0 0 0 0 0 0@0"});
  EXPECT_EQ(said(test::hex_text("FF 53 5A 28 29 03 04 05")), Said{"S 90 40 41 3 4 5@0"});
}

// An exchange as it is polled: acknowledged, answered in raw, prompted; 58 in the packet is the prompt's byte.
TEST(CmuCamDecoder, CutInAtAnyByteTheNextAnswerIsUnderstood) {
  const std::string once = "ACK\r" + test::hex_text("FF 4D 2D 3A 28 3A 32 50 14 80") + ":";
  EXPECT_EQ(said(once + once), (Said{"ACK", "M 45 58 40 58 50 80 20 128@4", "prompt()", "ACK",
                                     "M 45 58 40 58 50 80 20 128@19", "prompt()"}));
  for (std::size_t cut = 0; cut <= once.size(); ++cut) {
    const Said rest = said(once.substr(cut) + once);
    ASSERT_GE(rest.size(), 3U);
    EXPECT_EQ(rest.back(), "prompt()") << "cut " << cut;
    const std::string at = std::to_string(once.size() - cut + 4);
    EXPECT_EQ(rest[rest.size() - 2], "M 45 58 40 58 50 80 20 128@" + at) << "cut " << cut;
  }
}

TEST(CmuCamDecoder, LinesThatAreAlmostPackets) {
  for (const std::string_view line :
       {"T 1 2 3 4 5 6 7", "T 1 2 3 4 5 6 7 8 9", "T 1 2 3 4 5 6 7 256", "T 1 2 3 4 5 6 7 0008", "T 1 2 3 4 5 6 7 -8",
        "T 1 2 3 4 5 6 7 x", "T1 2 3 4 5 6 7 8", "T", "Q 1 2 3 4 5 6 7 8", "t 1 2 3 4 5 6 7 8", "S 1 2 3 4 5 6 7",
        "ACK ", "ACKACK", "NC", "C 1 2 3 4 5", "N 1 2 3 4 5 6 7 8", "T 1 2 3 4 5 6 7 8 9 10 11 12 13"}) {
    EXPECT_EQ(said(std::string(line) + "\r"), Said{"text(" + std::string(line) + ")"});
  }
  EXPECT_EQ(said("T  1 2 3 4 5 6 7 8 \r"), Said{"T 1 2 3 4 5 6 7 8@0"}) << "spaces more or less";
}

TEST(CmuCamDecoder, SaysNackAndNothing) {
  EXPECT_EQ(said("NCK\r:"), (Said{"NCK", "prompt()"}));
  EXPECT_EQ(said("\r\r\r"), Said{});
  EXPECT_EQ(said(":::"), (Said{"prompt()", "prompt()", "prompt()"}));
  EXPECT_EQ(said("ERR: Camera Timeout Error\r:"), (Said{"text(ERR: Camera Timeout Error)", "prompt()"}));
}

TEST(CmuCamDecoder, ALineTooLongIsDroppedAndCounted) {
  Decoder decoder;
  for (int i = 0; i < 5'000; ++i) EXPECT_EQ(decoder.feed('x', {}), Event::kNone);
  EXPECT_EQ(decoder.broken(), 1U);
  EXPECT_EQ(decoder.feed('\r', {}), Event::kNone);
  EXPECT_EQ(said("T 1 2 3 4 5 6 7 8\r", decoder), Said{"T 1 2 3 4 5 6 7 8@0"});
  const std::string longest(63, 'x');
  EXPECT_EQ(said(longest + "\r"), Said{"text(" + longest + ")"});
  EXPECT_EQ(said(longest + "x\r"), Said{});
}

}  // namespace
}  // namespace fencepost::cmucam
