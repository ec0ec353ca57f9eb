#include "drivers/pixy1/usb.hpp"

#include <gtest/gtest.h>

#include "tests/drivers/hex.hpp"
#include "tests/drivers/pixy1/rig.hpp"

namespace fencepost::pixy1 {
namespace {

using sensor::LinkState;
using test::hex;
using Bytes = std::vector<std::uint8_t>;

// By the rules of alignment: name at 16, flags at 21, width at 24, height at 28, count at 32, words from 36 on; of the
// second array the count at 48. Sig 1 from (140, 85) to (180, 115).
const std::string kPushed2 =
    "55 55 AA AA 18 00 00 00 28 00 00 00 64 64 64 64 43 43 42 32 41 01 42 42 40 01 42 42 C8 00 82 82 05 00 00 00 "
    "01 00 8C 00 B4 00 55 00 73 00 82 82 00 00 00 00";
const sensor::Blob kOneBlob{1, 140, 85, 179, 115, {1'595}, {1'000}, 0, {}};

TEST(Pixy1Usb, ReadsPushedBlocks) {
  const auto pushed = blocks_in(hex(kPushed2));
  ASSERT_TRUE(pushed);
  ASSERT_EQ(pushed->frame.blobs.size(), 1U);
  EXPECT_EQ(pushed->frame.blobs[0], kOneBlob);
  // A colour code 012, from (170, 70) to (230, 90), turned by -45 degrees; no block.
  const auto code = blocks_in(
      hex("55 55 AA AA 18 00 00 00 28 00 00 00 64 64 64 64 43 43 42 32 41 01 42 42 40 01 42 42 C8 00 82 82 00 00 00 00 "
          "82 82 82 82 06 00 00 00 0A 00 AA 00 E6 00 46 00 5A 00 D3 FF"));
  ASSERT_TRUE(code);
  ASSERT_EQ(code->frame.blobs.size(), 1U);
  EXPECT_EQ(code->frame.blobs[0], (sensor::Blob{10, 170, 70, 229, 90, {1'995}, {800}, 0, {}}));
}

TEST(Pixy1Usb, RefusesWhatCannotBe) {
  const Bytes whole = hex(kPushed2);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(blocks_in(std::span(whole).first(size))) << size;
  }
  // Type, name, flags' type, width, height, count, left beyond right, bottom below the image.
  for (const auto& [at, value] : {std::pair(4, 0x10),
                                  {16, 0x42},
                                  {20, 0x01},
                                  {24, 0x41},
                                  {28, 0xC9},
                                  {32, 0x06},
                                  {32, 0xFF},
                                  {38, 0xB4},
                                  {44, 0xC8},
                                  {36, 0x00}}) {
    Bytes wrong = whole;
    wrong[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(value);
    EXPECT_FALSE(blocks_in(wrong)) << at;
  }
}

TEST(Pixy1Usb, IntroducesItselfAndHasItRun) {
  UsbSession session{Options{}};
  base::Time now{};
  const auto says = [&](std::size_t size) {
    session.step(now);
    const auto waiting = session.outbox().waiting();
    EXPECT_TRUE(waiting.empty() || waiting.size() == 64);
    Bytes bytes(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(std::min(size, waiting.size())));
    session.outbox().clear();
    return bytes;
  };
  const auto hears = [&](const Bytes& bytes) {
    bool complete = false;
    for (const std::uint8_t byte : bytes) complete = session.take(byte, now) || complete;
    return complete;
  };
  EXPECT_EQ(says(18), hex("55 55 AA AA A1 00 00 00 06 00 00 00 02 02 40 00 01 01"));
  EXPECT_FALSE(hears(hex("55 55 AA AA 61 00 00 00 06 00 00 00 00 00 00 00 01 01 FF FF")));
  EXPECT_EQ(says(20), hex("55 55 AA AA A0 00 00 00 08 00 00 00 A1 72 75 6E 00 02 FF FF"));
  EXPECT_FALSE(hears(hex("55 55 AA AA 60 00 00 00 04 00 00 00 05 00 00 00")));
  EXPECT_EQ(says(12), hex("55 55 AA AA 80 00 05 00 00 00 00 00"));
  EXPECT_FALSE(hears(hex("55 55 AA AA 40 00 FF FF 04 00 00 00 00 00 00 00")));
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_TRUE(hears(hex(kPushed2)));
  EXPECT_EQ(session.link(), LinkState::kOk);
  EXPECT_EQ(says(1), Bytes{});
  now = now + base::milliseconds(501);
  EXPECT_EQ(says(5), hex("55 55 AA AA A1")) << "no image: it may have been switched off and on";
}

using Bench = test::Bench<test::Pixy1UsbRig>;
const sensor::Blob kNear{1, 100, 60, 219, 159, {1'595}, {1'095}, 0, {}};

TEST(Pixy1Usb, TakesEveryImageOnce) {
  for (const bool codes : {false, true}) {
    Bench bench;
    bench.device.tell_codes(codes);
    bench.run(2'000, {kNear});
    const std::size_t before = bench.frames.size();
    bench.run(1'000, {kNear});
    EXPECT_EQ(bench.frames.size() - before, 50U);
    ASSERT_EQ(bench.frames.back().blobs.size(), 1U);
    EXPECT_EQ(bench.frames.back().blobs[0], kNear);
    bench.run(40, {});
    EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
  }
}

TEST(Pixy1Usb, AHundredBlocksAreRead) {
  Bench bench;
  std::vector<sensor::Blob> many;
  for (std::int16_t i = 0; i < 100; ++i) many.push_back({2, 0, 0, static_cast<std::int16_t>(i), 9, {}, {}, 0, {}});
  bench.run(2'000, many);
  ASSERT_FALSE(bench.frames.empty());
  ASSERT_EQ(bench.frames.back().blobs.size(), 16U);
  EXPECT_EQ(bench.frames.back().blobs[0].x2, 99);
  EXPECT_EQ(bench.driver.dropped(), 84U * bench.frames.size());
}

// Its own start, and at worst one question that it did not hear yet.
TEST(Pixy1Usb, ComesBackAsSoonAsTheCameraDoes) {
  for (int phase = 0; phase < 500; phase += 20) {
    Bench bench;
    bench.run(2'000 + phase, {kNear});
    ASSERT_EQ(bench.driver.link(), LinkState::kOk);
    bench.restart(bench.clock.now());
    bench.run(1'400, {kNear});
    EXPECT_EQ(bench.driver.link(), LinkState::kOk) << phase;
    bench.link.unplug();
    bench.run(10, {kNear});
    EXPECT_EQ(bench.driver.link(), LinkState::kAbsent);
    bench.link.replug();
    bench.run(100, {kNear});
    EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  }
}

TEST(Pixy1Usb, WhateverArrivesABlockLiesInTheImage) {
  std::uint32_t state = 1;
  const Bytes whole = hex(kPushed2);
  for (int run = 0; run < 20'000; ++run) {
    UsbSession session{Options{}};
    for (int messages = 0; messages < 3; ++messages) {
      Bytes bytes = whole;
      for (int i = 0; i < 2; ++i) {
        state = state * 1'664'525U + 1'013'904'223U;
        bytes[(state >> 8U) % bytes.size()] = static_cast<std::uint8_t>(state >> 24U);
      }
      for (const std::uint8_t byte : bytes) {
        if (!session.take(byte, base::Time{} + base::milliseconds(messages))) continue;
        for (const sensor::Blob& blob : session.sample().blobs) {
          ASSERT_TRUE(blob.signature > 0 && blob.x1 >= 0 && blob.x1 <= blob.x2 && blob.x2 < kWidth);
          ASSERT_TRUE(blob.y1 >= 0 && blob.y1 <= blob.y2 && blob.y2 < kHeight);
        }
      }
    }
  }
}

TEST(Pixy1Usb, OfTwoImagesInOneHeapTheOlderIsGiven) {
  UsbSession session{Options{}};
  const base::Time now{1'000};
  session.step(now);
  std::size_t given = 0;
  for (int twice = 0; twice < 2; ++twice) {
    for (const std::uint8_t byte : hex(kPushed2)) given += session.take(byte, now);
  }
  EXPECT_EQ(given, 1U);
  for (const std::uint8_t byte : hex(kPushed2)) given += session.take(byte, now + base::milliseconds(1));
  EXPECT_EQ(given, 2U);
}

}  // namespace
}  // namespace fencepost::pixy1
