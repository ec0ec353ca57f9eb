#include "drivers/pixy1/usb.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <optional>

#include "tests/drivers/hex.hpp"
#include "tests/drivers/pixy1/rig.hpp"
#include "tests/drivers/says.hpp"

namespace fencepost::pixy1 {
namespace {

using sensor::LinkState;
using test::hex;
using Bytes = std::vector<std::uint8_t>;

// By the rules of alignment: name at 16, flags at 21, width at 24, height at 28, count at 32, words from 36 on. Of the
// second array the count is at 48.
const std::string kPushed2 =
    "55 55 AA AA 18 00 00 00 28 00 00 00 64 64 64 64 43 43 42 32 41 01 42 42 40 01 42 42 C8 00 82 82 05 00 00 00 "
    "01 00 8C 00 B4 00 55 00 73 00 82 82 00 00 00 00";
// Sig 1 from (140, 85) to (180, 115).
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

// Words of a block: signature, left, behind right, top, bottom.
std::optional<sensor::Blob> block_at(std::initializer_list<unsigned> words) {
  Bytes message = hex(kPushed2);
  std::size_t at = 36;
  for (const unsigned word : words) {
    message[at++] = static_cast<std::uint8_t>(word & 0xFFU);
    message[at++] = static_cast<std::uint8_t>(word >> 8U);
  }
  const auto pushed = blocks_in(message);
  return pushed && !pushed->frame.blobs.empty() ? std::optional(pushed->frame.blobs[0]) : std::nullopt;
}

TEST(Pixy1Usb, BlocksThatTouchTheEdgesAreInside) {
  EXPECT_EQ(block_at({255, 0, 320, 0, 199}), (sensor::Blob{255, 0, 0, 319, 199, {1'595}, {995}, 0, {}}));
  EXPECT_EQ(block_at({1, 7, 8, 9, 9}), (sensor::Blob{1, 7, 9, 7, 9, {70}, {90}, 0, {}})) << "one pixel";
  EXPECT_FALSE(block_at({1, 0, 321, 0, 199}));
  EXPECT_FALSE(block_at({1, 0, 320, 0, 200}));
  EXPECT_FALSE(block_at({1, 8, 8, 9, 9}));
  EXPECT_FALSE(block_at({1, 7, 8, 10, 9}));
  EXPECT_FALSE(block_at({0, 7, 8, 9, 9}));
  EXPECT_FALSE(block_at({256, 7, 8, 9, 9}));
}

TEST(Pixy1Usb, AColourCodeAbove255IsCounted) {
  for (const unsigned signature : {255U, 256U}) {
    Bytes message = hex(
        "55 55 AA AA 18 00 00 00 28 00 00 00 64 64 64 64 43 43 42 32 41 01 42 42 40 01 42 42 C8 00 82 82 00 00 00 00 "
        "82 82 82 82 06 00 00 00 0A 00 AA 00 E6 00 46 00 5A 00 D3 FF");
    message[44] = static_cast<std::uint8_t>(signature & 0xFFU);
    message[45] = static_cast<std::uint8_t>(signature >> 8U);
    const auto pushed = blocks_in(message);
    ASSERT_TRUE(pushed) << signature;
    EXPECT_EQ(pushed->frame.blobs.size(), signature == 255 ? 1U : 0U);
    EXPECT_EQ(pushed->dropped, signature == 255 ? 0U : 1U);
  }
}

TEST(Pixy1Usb, WhatTheFirstBytesOfAMessageAre) {
  const auto message = [](std::size_t length) {
    Bytes bytes = hex("55 55 AA AA 18 00 00 00 00 00 00 00");
    bytes[8] = static_cast<std::uint8_t>(length & 0xFFU);
    bytes[9] = static_cast<std::uint8_t>(length >> 8U);
    bytes.resize(bytes.size() + length, 0x11);
    return bytes;
  };
  const Bytes longest = message(kLongestMessage - chirp::kHeader);
  EXPECT_EQ(examine_message(longest).front, wire::Front::kMessage);
  EXPECT_EQ(examine_message(longest).size, kLongestMessage);
  EXPECT_EQ(examine_message(message(kLongestMessage - chirp::kHeader + 1)).front, wire::Front::kNoise);
  const Bytes short_one = message(3);
  for (std::size_t size = 1; size < short_one.size(); ++size) {
    EXPECT_EQ(examine_message(std::span(short_one).first(size)).front, wire::Front::kIncomplete) << size;
  }
  EXPECT_EQ(examine_message(short_one).size, 15U);
  for (std::size_t at = 0; at < 4; ++at) {
    Bytes damaged = short_one;
    damaged[at] ^= 1U;
    EXPECT_EQ(examine_message(std::span(damaged).first(4)).front, wire::Front::kNoise) << at;
  }
}

TEST(Pixy1Usb, WaitsForAnAnswerAndForAnImage) {
  UsbSession session{Options{}};
  const auto asks = [&](std::int64_t t) { return test::says(session, t); };
  EXPECT_TRUE(asks(0));
  EXPECT_FALSE(asks(2'999));
  EXPECT_TRUE(asks(3'000)) << "0.3 s";
  for (const std::uint8_t byte : hex(kPushed2)) (void)session.take(byte, {4'000});
  EXPECT_FALSE(asks(8'999));
  EXPECT_EQ(session.link(), LinkState::kOk);
  EXPECT_TRUE(asks(9'000)) << "half a second without an image";
  EXPECT_EQ(session.link(), LinkState::kOk);
  EXPECT_FALSE(asks(9'001));
  EXPECT_EQ(session.link(), LinkState::kSilent);
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
