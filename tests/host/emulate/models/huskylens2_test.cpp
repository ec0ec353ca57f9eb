#include "host/emulate/models/huskylens2.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kHuskylens2Up = base::Time{} + HuskyLens2::kDeaf;
// Of the vendor's library, as the next three: header, command, algorithm, length, data, sum.
const Bytes kAskKnock = hex("55 AA 20 00 0A 00 00 00 00 00 00 00 00 00 00 29");
const Bytes kAskColour = hex("55 AA 30 00 0A 05 00 00 00 00 00 00 00 00 00 3E");  // algorithm 5
const Bytes kAskResults = hex("55 AA 21 05 00 25");
const Bytes kOkay = hex("55 AA 40 00 0A 00 00 00 00 00 00 00 00 00 00 49");  // an answer

Bytes tell(HuskyLens2& camera, const Bytes& bytes, base::Time now = kHuskylens2Up) {
  Bytes reply;
  for (const std::uint8_t byte : bytes) {
    for (const std::uint8_t said : camera.take(byte, now)) reply.push_back(said);
  }
  return reply;
}

// 60 x 40 around (160, 120), id 1, confidence 90, "Color1", no content.
TEST(HuskyLens2Model, AnswersWithItsFrames) {
  HuskyLens2 camera;
  camera.show({{1, 130, 100, 189, 139, {}, {}, 0, {}}});
  EXPECT_EQ(tell(camera, kAskKnock), kOkay);
  EXPECT_EQ(tell(camera, kAskResults), hex("55 AA 41 05 0A 00 00 00 00 00 00 00 00 00 00 4F"))
      << "of another algorithm";
  EXPECT_EQ(tell(camera, kAskColour), kOkay);
  EXPECT_EQ(tell(camera, kAskResults), hex("55 AA 42 05 0A 01 00 01 00 01 00 01 00 01 00 55 "
                                           "55 AA 43 05 12 01 5A A0 00 78 00 3C 00 28 00 06 43 6F 6C 6F 72 31 00 66"));
}

TEST(HuskyLens2Model, NamesWhatItDoesNotDo) {
  HuskyLens2 camera;
  EXPECT_EQ(tell(camera, hex("55 AA 50 00 00 4F")), Bytes{});
  EXPECT_EQ(tell(camera, kAskKnock), kOkay);
  EXPECT_EQ(camera.not_emulated(), (std::vector<std::string>{"command 50"}));
}

TEST(HuskyLens2Model, WhatTheOtherIsAskedSwallowsWhatFollows) {
  HuskyLens2 camera;
  // A length of 0x2C: with its sum 45 bytes more, of which the last of the knock is the first.
  EXPECT_EQ(tell(camera, hex("55 AA 11 00 2C 3C")), Bytes{});
  EXPECT_EQ(tell(camera, kAskKnock), Bytes{});
  EXPECT_EQ(tell(camera, kAskKnock), Bytes{});
  EXPECT_EQ(tell(camera, kAskKnock), Bytes{}) << "44 bytes of 48: the rest is none of a frame";
  EXPECT_EQ(tell(camera, kAskKnock), kOkay);
}

TEST(HuskyLens2Model, IsDeafAtFirstAndForgetsItsAlgorithm) {
  HuskyLens2 camera;
  EXPECT_EQ(tell(camera, kAskKnock, kHuskylens2Up - base::milliseconds(1)), Bytes{});
  EXPECT_EQ(tell(camera, kAskColour), kOkay);
  static_cast<void>(camera.power_up(kHuskylens2Up));
  EXPECT_EQ(tell(camera, kAskResults, kHuskylens2Up + HuskyLens2::kDeaf).at(2), 0x41);
  EXPECT_EQ(tell(camera, hex("55 AA 20 00 00 20"), kHuskylens2Up + HuskyLens2::kDeaf), Bytes{}) << "a wrong sum";
}

TEST(HuskyLens2Model, IsDescribed) {
  EXPECT_EQ(describe_huskylens2(true, kAskKnock), "knock");
  EXPECT_EQ(describe_huskylens2(false, hex("55 AA 42 05 0A 01 00 02 00")), "INFO, 2 objects");
  EXPECT_EQ(describe_huskylens2(false, hex("01 02")), "");
}

}  // namespace
}  // namespace fencepost::emulate
