#include "host/emulate/models/pixy1.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"

namespace fencepost::emulate {
namespace {

using test::hex;

constexpr base::Time kPixy1Up = base::Time{} + Pixy1::kStart;
// Of the document's example: sig 1 at (160, 100), 40 x 30.
const sensor::Blob kOne{1, 140, 85, 179, 115, {}, {}, 0, {}};
const sensor::Blob kTwo{2, 44, 55, 55, 65, {}, {}, 0, {}};  // sig 2 at (50, 60), 12 x 10

// The document's example, with both.
const Bytes kBoth = hex("55 AA 55 AA 4B 01 01 00 A0 00 64 00 28 00 1E 00 55 AA 86 00 02 00 32 00 3C 00 0C 00 0A 00");

TEST(Pixy1Model, SendsAnImageAsTheDocumentHasIt) {
  Pixy1 camera(0);
  camera.show({kTwo, kOne});
  EXPECT_EQ(camera.next(), kPixy1Up);
  Bytes expected = hex("00 00");
  expected.insert(expected.end(), kBoth.begin(), kBoth.end());
  EXPECT_EQ(camera.step(kPixy1Up), expected);
  EXPECT_EQ(camera.next(), kPixy1Up + Pixy1::kImage);
}

TEST(Pixy1Model, ColourCodesCome) {
  Pixy1 camera(0);
  camera.show_code({10, 170, 230, 70, 90, -45});
  EXPECT_EQ(camera.step(kPixy1Up), hex("00 00 55 AA 56 AA 45 01 0A 00 C8 00 50 00 3C 00 14 00 D3 FF"));
}

TEST(Pixy1Model, NamesWhatItIsTold) {
  Pixy1 camera(0);
  for (const std::uint8_t byte : hex("00 FF F4 01 F4 01 00 FE 80 00 FD 10 20 30")) (void)camera.take(byte, kPixy1Up);
  EXPECT_EQ(camera.not_emulated(), (std::vector<std::string>{"servos", "brightness", "lamp"}));
}

TEST(Pixy1Model, WithoutBlocksItSendsZeros) {
  Pixy1 camera(19'200);
  EXPECT_EQ(camera.step(kPixy1Up), hex("00 00"));
  EXPECT_EQ(camera.next(), kPixy1Up + Pixy1::kImage);
}

// At 19200 baud 14 bytes take 7.3 ms: of five blocks three go, and the next image has its mark at once.
TEST(Pixy1Model, WhatWasNotSentInTimeIsCutOff) {
  Pixy1 camera(19'200);
  camera.show({kOne, kOne, kOne, kOne, kOne});
  Bytes first;
  while (*camera.next() < kPixy1Up + Pixy1::kImage) {
    for (const std::uint8_t byte : camera.step(*camera.next())) first.push_back(byte);
  }
  EXPECT_EQ(first.size(), 2U + 2U + 3U * 14U);
  EXPECT_EQ(camera.step(*camera.next()), Bytes{}) << "the line is busy";
  const Bytes next = camera.step(*camera.next());
  EXPECT_EQ(Bytes(next.begin(), next.begin() + 6), hex("55 AA 55 AA 4B 01"));
}

TEST(Pixy1Model, ABusReadsBlocksThenZeros) {
  Pixy1 camera(0);
  camera.show({kOne, kTwo});
  EXPECT_EQ(camera.pull(4, kPixy1Up - base::milliseconds(1)), hex("00 00 00 00"));
  Bytes read = camera.pull(16, kPixy1Up);
  for (const std::uint8_t byte : camera.pull(16, kPixy1Up)) read.push_back(byte);
  Bytes expected = kBoth;
  expected.insert(expected.end(), {0, 0});
  EXPECT_EQ(read, expected);
}

TEST(Pixy1Model, IsDescribed) {
  EXPECT_EQ(describe_pixy1(false, hex("00 00")), "nothing");
  EXPECT_EQ(describe_pixy1(false, kBoth), "image, 2 blocks");
  EXPECT_EQ(describe_pixy1(true, hex("00 FF F4 01 FA 00")), "");
}

}  // namespace
}  // namespace fencepost::emulate
