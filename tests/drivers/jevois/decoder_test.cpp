#include "drivers/jevois/decoder.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/drivers/hex.hpp"

namespace fencepost::jevois {
namespace {

struct Reading {
  Reading& bytes(std::string_view bytes) {
    for (const char byte : bytes) {
      if (decoder.feed(test::octet(byte), now) == Event::kFrame) frames.push_back(decoder.frame());
      ++now.raw;
    }
    return *this;
  }
  Reading& frame(std::string_view line) {
    return bytes("MARK START\r\n").bytes(line).bytes("\r\n").bytes("MARK STOP\r\n");
  }

  Decoder decoder{[] {
    Names names;
    (void)names.push_back({"red_ball", 7});
    return names;
  }()};
  base::Time now{0};
  std::vector<sensor::BlobFrame> frames;
};

sensor::Blob only(std::string_view line) {
  Reading reading;
  reading.frame(line);
  EXPECT_EQ(reading.frames.size(), 1U) << line;
  if (reading.frames.empty() || reading.frames[0].blobs.empty()) return {};
  return reading.frames[0].blobs[0];
}

// The document's example: 320x240, centre (200, 90), 64 x 48 px: columns 168 to 231, rows 66 to 113.
constexpr sensor::Blob kBall{7, 168, 66, 231, 113, {1'995}, {895}, 0, {}};
// y = -188 is rounded from -187.5, which is 0.08 pixels: the same rows.
constexpr std::string_view kExample = "12 MARK START\r\n12 N2 red_ball 250 -187.5 400 300\r\n12 MARK STOP\r\n";

TEST(JevoisDecoder, TheWorkedExample) {
  Reading reading;
  reading.bytes(kExample);
  ASSERT_EQ(reading.frames.size(), 1U);
  EXPECT_EQ(reading.frames[0].frame, 12U);
  EXPECT_EQ(reading.frames[0].t.raw, 0) << "the first byte of the first mark";
  ASSERT_EQ(reading.frames[0].blobs.size(), 1U);
  EXPECT_EQ(reading.frames[0].blobs[0], kBall);
  sensor::Blob rounded = only("N2 red_ball 250 -188 400 300");
  EXPECT_EQ(rounded.cy.raw, 894) << "0.75 * (2000 * 89.9 / 240 - 1000) = -188";
  rounded.cy = kBall.cy;
  EXPECT_EQ(rounded, kBall);
}

TEST(JevoisDecoder, TheWholePictureAndItsCorners) {
  EXPECT_EQ(only("N2 red_ball 0 0 2000 1500"), (sensor::Blob{7, 0, 0, 319, 239, {1'595}, {1'195}, 0, {}}));
  EXPECT_EQ(only("N2 red_ball -996.875 -746.875 6.25 6.25"), (sensor::Blob{7, 0, 0, 0, 0, {0}, {0}, 0, {}}));
  EXPECT_EQ(only("N2 red_ball -0 -0.0 6.25 6.25").x1, 160) << "-0 is written";
  EXPECT_EQ(only("N2 red_ball 900 0 400 300").x2, 319) << "cut off at the edge";
}

// The same box as polygons: as the manual has them, as the sources write them (second vertex twice), and with the
// count.
TEST(JevoisDecoder, PolygonsAreTheirBox) {
  for (const std::string_view line :
       {"D2 red_ball 50 -337.5 450 -337.5 450 -37.5 50 -37.5", "D2 red_ball 50 -337.5 450 -337.5 450 -37.5 450 -337.5",
        "D2 red_ball 4 50 -337.5 450 -337.5 450 -37.5 50 -37.5",
        "D2 red_ball 50 -337.5 450 -337.5 450 -37.5 50 -37.5 and more",
        "F2 red_ball 5 50 -187.5 250 -337.5 450 -187.5 450 -37.5 250 -37.5"}) {
    EXPECT_EQ(only(line), kBall) << line;
  }
}

TEST(JevoisDecoder, EveryStamp) {
  for (const std::string stamp : {"", "5 ", "12:34:56 ", "5/12:34:56 ", "5/2020-01-31/12:34:56 "}) {
    Reading reading;
    reading.bytes(stamp + "MARK START\n" + stamp + "N2 red_ball 250 -187.5 400 300\n" + stamp + "MARK STOP\n");
    ASSERT_EQ(reading.frames.size(), 1U) << stamp;
    EXPECT_EQ(reading.frames[0].blobs.size(), 1U) << stamp;
    EXPECT_EQ(reading.frames[0].frame, stamp.find('5') == 0 ? 5U : 1U) << stamp;
  }
}

TEST(JevoisDecoder, WhatAThingIsCalled) {
  EXPECT_EQ(only("N2 red_ball 0 0 400 300").signature, 7);
  EXPECT_EQ(only("N2 blob2 0 0 400 300").signature, 2);
  EXPECT_EQ(only("N2 31 0 0 400 300").signature, 31);
  for (const std::string_view id : {"unknown", "blob0", "blob256", "blob4294967297", "red_balls"}) {
    EXPECT_EQ(only("N2 " + std::string(id) + " 0 0 400 300").signature, 1) << id;
  }
}

TEST(JevoisDecoder, EachLineOfAFrameCounts) {
  const std::string start = "1 MARK START\n";
  const std::string ball = "1 N2 red_ball 250 -188 400 300\n";
  const std::string stop = "1 MARK STOP\n";
  EXPECT_EQ(Reading().bytes(start + stop).frames.size(), 1U) << "nothing is seen";
  for (const std::string& bytes :
       {start + start, ball + stop, start + ball + "2 MARK STOP\n", start + "1 N2 red_ball 250 -188 40x 300\n" + stop,
        start + "1 N2 red_ball 250 -188 400\n" + stop, start + "1 X2 red_ball 250 -188 400 300\n" + stop,
        start + "1 N2 red_ball 250 -188 0 300\n" + stop, start + "1 N2 red_ball 250 -188 -400 300\n" + stop,
        start + "1 N2 red_ball 250 -188 400 300 5\n" + stop, start + "1 N2 red_ball 3000 -188 400 300\n" + stop,
        start + "1 N2 red_ball 25000 -188 400 300\n" + stop, start + "1 MARK STAPT\n" + stop,
        start + "1 D2 red_ball 5 50 -337 450 -337 450 -37 50 -37\n" + stop,
        start + std::string(300, 'x') + "\n" + stop}) {
    EXPECT_TRUE(Reading().bytes(bytes).frames.empty()) << bytes;
  }
  for (const std::string line : {"1 T2 0 -188", "1 N1 x 0 10", "1 N3 x 0 0 0 1 1 1", "1 NO dog:80"}) {
    Reading reading;
    EXPECT_TRUE(reading.bytes(start + line + "\n" + stop).frames.empty()) << "it would look as if nothing were there";
    EXPECT_EQ(reading.decoder.counts().unused, 1U) << line;
  }
  for (const std::string line : {"OK", "ERR Command error", "INF Engine::mainLoop: on", ""}) {
    EXPECT_EQ(Reading().bytes(start + line + "\n" + ball + stop).frames.size(), 1U) << line;
  }
}

TEST(JevoisDecoder, KnowsWhetherItComesAsTold) {
  const auto as_told = [](std::string_view bytes) {
    Reading reading;
    reading.bytes(bytes);
    return reading.frames.size() == 1 && reading.decoder.as_told();
  };
  EXPECT_TRUE(as_told("1 MARK START\n1 N2 blob2 0.0 -0.0 12.5 300.0\n1 MARK STOP\n"));
  EXPECT_FALSE(as_told("1 MARK START\n1 N2 blob2 0 -0 12 300\n1 MARK STOP\n"));
  EXPECT_FALSE(as_told("MARK START\nMARK STOP\n"));
}
TEST(JevoisDecoder, KeepsTheLargestAndCountsTheOthers) {
  Reading reading;
  reading.bytes("MARK START\n");
  for (int i = 0; i < 20; ++i) reading.bytes("N2 blob2 0 0 " + std::to_string(100 + 20 * i) + " 300\n");
  reading.bytes("MARK STOP\n");
  ASSERT_EQ(reading.frames.size(), 1U);
  EXPECT_EQ(reading.frames[0].blobs.size(), 16U);
  EXPECT_GT(reading.frames[0].blobs[0].x2, reading.frames[0].blobs[1].x2);
  EXPECT_EQ(reading.decoder.counts().dropped, 4U);
}

// In hundredths, of 320 x 240 pixels: what touches the picture from outside by its edge alone is outside.
TEST(JevoisDecoder, BoxesAtTheEdgesOfThePicture) {
  for (const std::string_view line :
       {"N2 a 1050 0 100 100", "N2 a -1050 0 100 100", "N2 a 0 800 100 100", "N2 a 0 -800 100 100"}) {
    Reading reading;
    EXPECT_TRUE(reading.frame(line).frames.empty()) << line;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << line;
  }
  // A hundredth inside: a pixel of the edge, whose middle is there.
  EXPECT_EQ(only("N2 a 1049.99 0 100 6.25"), (sensor::Blob{1, 319, 120, 319, 120, {3'190}, {1'195}, 0, {}}));
  EXPECT_EQ(only("N2 a -1049.99 0 100 6.25"), (sensor::Blob{1, 0, 120, 0, 120, {0}, {1'195}, 0, {}}));
  EXPECT_EQ(only("N2 a 0 799.99 6.25 100"), (sensor::Blob{1, 160, 239, 160, 239, {1'595}, {2'390}, 0, {}}));
  EXPECT_EQ(only("N2 a 0 -799.99 6.25 100"), (sensor::Blob{1, 160, 0, 160, 0, {1'595}, {0}, 0, {}}));
}

TEST(JevoisDecoder, NumbersAndNamesToTheirLastDigit) {
  EXPECT_EQ(only("N2 blob255 0 0 400 300").signature, 255);
  EXPECT_EQ(only("N2 blob1 0 0 400 300").signature, 1);
  EXPECT_EQ(only("N2 a9z2 0 0 400 300").signature, 2) << "the digits at its end";
  const auto frame_number = [](const std::string& stamp) {
    Reading reading;
    reading.bytes(stamp + " MARK START\n" + stamp + " MARK STOP\n");
    return reading.frames.size() == 1 ? reading.frames[0].frame : 0U;
  };
  EXPECT_EQ(frame_number("999999999"), 999'999'999U);
  EXPECT_EQ(frame_number("1000000000"), 1U) << "of ten digits is none: counted by itself";
  EXPECT_EQ(frame_number("31:02"), 1U) << "a time";
  // Decimals behind the second are dropped: 6.259 is 6.25.
  EXPECT_EQ(only("N2 a 0 0 6.259 6.251").x1, only("N2 a 0 0 6.25 6.25").x1);
  EXPECT_EQ(only("N2 a 112.55 0 6.25 6.25").cx.raw, 1'775) << "112.55 of 2000 by 320 pixels, less half a one";
  EXPECT_EQ(only("N2 a -112.45 0 6.25 6.25").cx.raw, 1'415);
}

TEST(JevoisDecoder, WhatBeginsWithADigitIsNoStampForAll) {
  Reading reading;
  EXPECT_TRUE(reading.bytes("5x MARK START\n5x MARK STOP\n").frames.empty());
  EXPECT_EQ(reading.decoder.counts().damaged, 2U);
  EXPECT_EQ(Reading().bytes("5-6 MARK START\n5-6 MARK STOP\n").frames.size(), 1U);
}

TEST(JevoisDecoder, PolygonsHaveThreePointsAtLeast) {
  const auto frames = [](std::string_view line) { return Reading().frame(line).frames.size(); };
  EXPECT_EQ(frames("D2 a 0 0 100 0 100 100"), 1U);
  EXPECT_EQ(frames("D2 a 3 0 0 100 0 100 100"), 1U);
  EXPECT_EQ(frames("D2 a 0 0 100 0"), 0U);
  EXPECT_EQ(frames("D2 a 2 0 0 100 0"), 0U);
  EXPECT_EQ(frames("D2 a 4 0 0 100 0 100 100"), 0U) << "another count";
  EXPECT_EQ(frames("D2 a"), 0U);
  // The extremes are at any of its points.
  for (const std::string_view line :
       {"D2 a 100 0 -100 50 0 -50", "D2 a -100 50 100 0 0 -50", "D2 a 0 -50 -100 0 100 50"}) {
    const sensor::Blob blob = only(line);
    EXPECT_EQ(blob.x1, 144) << line;
    EXPECT_EQ(blob.x2, 175) << line;
    EXPECT_EQ(blob.y1, 112) << line;
    EXPECT_EQ(blob.y2, 127) << line;
  }
}

TEST(JevoisDecoder, CountsWhatItGivesUp) {
  Reading reading;
  reading.bytes("MARK START\n").bytes("MARK START\n").bytes("MARK STOP\n");
  EXPECT_EQ(reading.frames.size(), 1U);
  EXPECT_EQ(reading.decoder.counts().incomplete, 1U) << "begun anew";
  reading.bytes("1 MARK START\n2 MARK STOP\n");
  EXPECT_EQ(reading.decoder.counts().incomplete, 2U) << "another stamp";
  reading.bytes("MARK START\nrubbish\nMARK STOP\n");
  EXPECT_EQ(reading.decoder.counts().incomplete, 3U);
  EXPECT_EQ(reading.decoder.counts().damaged, 1U);
  reading.bytes("rubbish\n");
  EXPECT_EQ(reading.decoder.counts().incomplete, 3U) << "there was none";
  EXPECT_EQ(reading.decoder.counts().damaged, 2U);
  EXPECT_EQ(reading.frames.size(), 1U);
}

TEST(JevoisDecoder, BoxesThatCannotBeEndTheirFrame) {
  for (const std::string_view line :
       {"N2 a 0 0 400", "N2 a 0 0 400 300 5", "N2 a 0 0 400 300 more", "N2 a 0 0 0 300", "N2 a 0 0 400 0",
        "N2 a 0 0 400 -1", "N2 a 1.x 0 400 300", "N2 a 1. 0 400 300", "N2 a -1200 0 400 300", "N2 a 1200 0 400 300",
        "N2 a 0 -900 400 300", "N2 a 0 900 400 300", "N2 a 00000 0 400 300"}) {
    Reading reading;
    EXPECT_TRUE(reading.frame(line).frames.empty()) << line;
    EXPECT_EQ(reading.decoder.counts().impossible, 1U) << line;
  }
}

}  // namespace
}  // namespace fencepost::jevois
