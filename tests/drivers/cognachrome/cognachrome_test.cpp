#include "drivers/cognachrome/cognachrome.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/drivers/hex.hpp"

namespace fencepost::cognachrome {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;
using test::hex;
using Bytes = std::vector<std::uint8_t>;

Bytes text(std::string_view said) { return test::bytes_of(said); }

// A at column 120, row 80 with 600 pixels; B at 33, 210 is below the image: 110 here, 45 pixels.
const Bytes kFrame = hex("FF 61 00 78 00 50 02 5C 62 00 21 00 6E 00 2D");
const Bytes kMark = hex("FF");  // of the next frame

// 600 pixels: 23 columns. 23 x 23 x 16 = 8464 is at most 600 x 15 = 9000, and 24 x 24 x 16 is not.
const sensor::Blob kA{1, 109, 0, 131, 199, {1'200}, {800}, 600, {}};
// 45 pixels: 6 columns, the sixth to the right of the middle.
const sensor::Blob kB{2, 31, 0, 36, 199, {330}, {1'100}, 45, {}};

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<sensor::Blob> blobs_of(const sensor::BlobFrame& frame) { return {frame.blobs.begin(), frame.blobs.end()}; }

struct Listener {
  explicit Listener(const Format& format = kBinary) : decoder(format) {}
  Decoder decoder;
  Time now{};

  std::vector<std::vector<sensor::Blob>> hears(const Bytes& bytes) {
    std::vector<std::vector<sensor::Blob>> frames;
    for (const std::uint8_t byte : bytes) {
      now = now + milliseconds(1);
      if (decoder.feed(byte, now)) frames.push_back(blobs_of(decoder.frame()));
    }
    return frames;
  }
};
using Frames = std::vector<std::vector<sensor::Blob>>;

TEST(Cognachrome, ReadsWhatMissionLabInstalls) {
  Listener listener;
  EXPECT_EQ(listener.hears(kFrame), Frames{}) << "more objects may follow";
  EXPECT_EQ(listener.hears(kMark), (Frames{{kA, kB}}));
  EXPECT_EQ(listener.decoder.frame().t, Time{} + milliseconds(1)) << "the first mark";
  EXPECT_EQ(listener.hears(kMark), Frames{{}}) << "an empty frame is a mark alone";
}

TEST(Cognachrome, ReadsWhatTeamBotsReads) {
  Listener listener(kHex);
  // Roots 24 and 6 of the pixels; 576 pixels are 23 columns, 36 are 5.
  const Frames frames = listener.hears(text("$1A#18:78:50:20&06:21:6E:00\r\n$1B$1C^FF:00:00:00$"));
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0], (std::vector<sensor::Blob>{{1, 109, 0, 131, 199, {1'200}, {800}, 576, {}},
                                                  {2, 31, 0, 35, 199, {330}, {1'100}, 36, {}}}));
  EXPECT_TRUE(frames[1].empty());
  EXPECT_EQ(listener.decoder.counts().broken, 1U) << "255 by 255 pixels are more than there are";
}

TEST(Cognachrome, HexDigitsHaveTheirValues) {
  Listener listener(kHex);
  // Columns 9, 10, 15 by both cases, and roots of one pixel.
  const Frames frames = listener.hears(text("$00#1:9:10:0#1:A:10:0#1:F:10:0#1:a:10:0#1:f:1a:0$"));
  ASSERT_EQ(frames.size(), 1U);
  std::vector<std::int32_t> columns;
  for (const sensor::Blob& blob : frames[0]) columns.push_back(blob.cx.raw);
  std::sort(columns.begin(), columns.end());
  EXPECT_EQ(columns, (std::vector<std::int32_t>{90, 100, 100, 150, 150}));
  EXPECT_EQ(frames[0].back().cy.raw, 260) << "row 1a";
}

// A field has one or two digits, four fields have three colons.
TEST(Cognachrome, WhatIsNoRecordOfHexBreaksItsFrame) {
  for (const char* damaged :
       {"$1A#:78:50:20$", "$1A#18::50:20$", "$1A#18:78:50$", "$1A#18:78:50:$", "$1A#18:78:50:20:$", "$1A#118:78:50:20$",
        "$1A#18:78:50:120$", "$1A#18:78#50:20$", "$1A#18:78:50:20x$"}) {
    Listener listener(kHex);
    EXPECT_EQ(listener.hears(text(damaged)).size(), 0U) << damaged;
    EXPECT_EQ(listener.decoder.counts().broken, 1U) << damaged;
  }
  for (const char* whole : {"$1A#18:78:50:20$", "$1A#18:78:50:2$", "$1A#18:78:50:20 \r\n#6:21:6E:00$"}) {
    Listener listener(kHex);
    EXPECT_EQ(listener.hears(text(whole)).size(), 1U) << whole;
  }
}

TEST(Cognachrome, BoxesEndAtTheImage) {
  EXPECT_EQ(blob_of(0, 0, 0, 600), (sensor::Blob{1, 0, 0, 11, 199, {0}, {0}, 600, {}}));
  EXPECT_EQ(blob_of(2, 249, 199, 1), (sensor::Blob{3, 249, 0, 249, 199, {2'490}, {1'990}, 1, {}}));
  // Pixels are 16/15 as wide as high, and a box is as wide as a square of its pixels. Its width is the
  // largest w with w w 16/15 at most that number: w = 1 up to four pixels, 2 up to nine.
  for (const auto& [pixels, width] : {std::pair(1, 1), {4, 1}, {5, 2}, {9, 2}, {10, 3}, {50'000, 216}}) {
    const std::optional<sensor::Blob> blob = blob_of(0, 120, 10, pixels);
    EXPECT_EQ(blob->x2 - blob->x1 + 1, width) << pixels;
  }
  for (const auto& [column, row, pixels] : {std::tuple(250, 0, 1), {0, 200, 1}, {0, 0, 0}, {0, 0, 50'001}}) {
    EXPECT_EQ(blob_of(0, column, row, pixels), std::nullopt);
  }
}

TEST(Cognachrome, MoreObjectsThanAFrameHoldsAreCounted) {
  Bytes frame = kMark;
  for (std::uint8_t i = 1; i <= 20; ++i) {
    frame = frame + Bytes{'a', 0, 100, 0, 100, 0, i};
  }
  Listener listener;
  const Frames frames = listener.hears(frame + kFrame + kMark);
  ASSERT_EQ(frames.size(), 2U);
  ASSERT_EQ(frames[0].size(), 16U);
  EXPECT_EQ(frames[0][0].pixels, 20U);
  EXPECT_EQ(frames[0][15].pixels, 5U);
  EXPECT_EQ(listener.decoder.counts().blobs_dropped, 4U);
  EXPECT_EQ(frames[1], (std::vector{kA, kB}));
}

// Prompt by prompt, as MissionLab answers them.
TEST(CognachromeSession, InstallsItsStrings) {
  Session session{Config{}};
  Time now{};
  const auto says = [&] {
    session.step(now);
    const auto waiting = session.outbox().waiting();
    Bytes bytes(waiting.begin(), waiting.end());
    session.outbox().clear();
    return bytes;
  };
  const auto hears = [&](std::string_view text) {
    for (const char c : text) static_cast<void>(session.take(static_cast<std::uint8_t>(c), now));
  };
  const Bytes to_vision = hex("FE 03");
  EXPECT_EQ(says(), Bytes{}) << "it listens first";
  now = now + milliseconds(500);
  EXPECT_EQ(says(), to_vision + text("\nqph"));
  hears("tpuvis [a]> ph\r\nNew protocol header:");
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_EQ(says(), to_vision + text("\\377\npa"));
  hears("\\377\r\ntpuvis [a]> pa\r\nNew protocol chan A:");
  EXPECT_EQ(says(), to_vision + text("a%wC%wR%wN\npb"));
  hears("\r\nNew protocol chan B:");
  EXPECT_EQ(says(), to_vision + text("b%wC%wR%wN\npc"));
  hears("\r\nNew protocol chan C:");
  EXPECT_EQ(says(), to_vision + text("c%wC%wR%wN\nr"));
  std::size_t frames = 0;
  for (const std::uint8_t byte : kFrame + kMark) frames += session.take(byte, now) ? 1U : 0U;
  EXPECT_EQ(session.link(), LinkState::kUnready) << "one frame may be noise";
  EXPECT_EQ(frames, 0U);
  now = now + milliseconds(17);
  for (const std::uint8_t byte : kFrame + kMark) frames += session.take(byte, now) ? 1U : 0U;
  EXPECT_EQ(session.link(), LinkState::kOk);
  EXPECT_EQ(frames, 2U);
  now = now + milliseconds(490);
  EXPECT_EQ(says(), Bytes{}) << "it tracks";
  hears("New protocol header:");
  EXPECT_EQ(says(), Bytes{}) << "nobody asked for that";
}

// Two frames no more than 100 ms apart; and half a second without one, or without a byte.
TEST(CognachromeSession, HowLongAFrameCounts) {
  for (const auto& [apart, taken] : {std::pair(100, true), {101, false}}) {
    Session session{Config{}};
    Time now{};
    const auto hears_mark = [&] { return session.take(0xFF, now); };
    static_cast<void>(hears_mark());
    EXPECT_FALSE(hears_mark()) << "the first";
    now = now + milliseconds(apart);
    EXPECT_EQ(hears_mark(), taken) << apart;
    session.step(now = now + milliseconds(500));
    EXPECT_EQ(session.link(), taken ? LinkState::kEmpty : LinkState::kUnready) << apart;
    session.step(now = now + milliseconds(1));
    EXPECT_EQ(session.link(), LinkState::kSilent) << apart;
  }
}

TEST(CognachromeSession, APromptThatDoesNotComeIsGivenUp) {
  Session session{Config{}};
  std::size_t tries = 0;
  for (int ms = 0; ms < 10'000; ++ms) {
    session.step(Time{} + milliseconds(ms));
    tries += session.outbox().waiting().empty() ? 0U : 1U;
    session.outbox().clear();
  }
  EXPECT_EQ(tries, 32U) << "500 ms, then every 300 ms";
  EXPECT_EQ(session.link(), LinkState::kSilent);
}

TEST(CognachromeSession, WhoseStringsAreNotKnownIsOnlyListenedTo) {
  Session session{Config{&kHex}};
  for (int ms = 0; ms < 10'000; ++ms) session.step(Time{} + milliseconds(ms));
  EXPECT_TRUE(session.outbox().waiting().empty());
}

}  // namespace
}  // namespace fencepost::cognachrome
