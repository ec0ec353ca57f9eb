#include "drivers/huskylens/huskylens.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "drivers/wire/i2c_stream.hpp"
#include "host/emulate/models/huskylens.hpp"
#include "host/emulate/models/huskylens2.hpp"
#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/cable.hpp"
#include "tests/drivers/bench/i2c_cable.hpp"

namespace fencepost::huskylens {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;
using test::hex;
using Bytes = std::vector<std::uint8_t>;

// Bytes of the vendor's document, with the sums computed.

const Bytes kKnock = hex("55 AA 11 00 2C 3C");
const Bytes kOk = hex("55 AA 11 00 2E 3E");
const Bytes kColour = hex("55 AA 11 02 2D 04 00 43");
const Bytes kAskBlocks = hex("55 AA 11 00 21 31");
const Bytes kInfo8 = hex("55 AA 11 0A 29 01 00 01 00 08 00 00 00 00 00 4D");
const Bytes kInfo9 = hex("55 AA 11 0A 29 01 00 01 00 09 00 00 00 00 00 4E");
const Bytes kBlock = hex("55 AA 11 0A 2A A0 00 78 00 3C 00 28 00 01 00 C1");
const Bytes kArrow = hex("55 AA 11 0A 2B 14 00 0A 00 2C 01 C8 00 01 00 59");
const Bytes kNone9 = hex("55 AA 11 0A 29 00 00 01 00 09 00 00 00 00 00 4D");
const Bytes kUntaught = hex("55 AA 11 0A 29 00 00 00 00 09 00 00 00 00 00 4C");
const Bytes kBusy = hex("55 AA 11 00 3D 4D");

/// A session on a clock; its output and its input.
struct Talk {
  Session session{Options{}};
  Time now{};

  Bytes asks() {
    session.step(now);
    const auto waiting = session.outbox().waiting();
    Bytes bytes(waiting.begin(), waiting.end());
    session.outbox().clear();
    return bytes;
  }
  /// A byte a millisecond, as at 9600 baud.
  std::vector<sensor::BlobFrame> hears(const Bytes& bytes) {
    std::vector<sensor::BlobFrame> frames;
    for (const std::uint8_t byte : bytes) {
      now = now + milliseconds(1);
      session.take(byte, now);
      if (const auto frame = session.take_frame()) frames.push_back(*frame);
    }
    return frames;
  }
  void wait(std::int64_t ms) { now = now + milliseconds(ms); }
  /// To the first question for blocks.
  void start() {
    EXPECT_EQ(asks(), kKnock);
    hears(kOk);
    EXPECT_EQ(asks(), kColour);
    hears(kOk);
    EXPECT_EQ(asks(), kAskBlocks);
  }
};

Bytes operator+(Bytes a, const Bytes& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::optional<sensor::Blob> blob_of(const Bytes& data) {
  return blob_in({Generation::kOne, Kind::kBlock, data}, kWidth);
}

// 60 x 40 around (160, 120): columns 130 to 189, rows 100 to 139, whose middles are 159.5 and 119.5.
const sensor::Blob kBox{1, 130, 100, 189, 139, {1'595}, {1'195}, 0, {}};

TEST(HuskyLens, BringsItsBoxesToOurPixels) {
  const auto data = [](const char* text) { return blob_of(hex(text)); };
  EXPECT_EQ(data("A0 00 78 00 3C 00 28 00 01 00"), kBox);
  // 3 x 1 around (10, 0): an odd number of pixels has its middle one there.
  EXPECT_EQ(data("0A 00 00 00 03 00 01 00 07 00"), (sensor::Blob{7, 9, 0, 11, 0, {100}, {0}, 0, {}}));
  // All of the image, 320 x 240 around (160, 120).
  EXPECT_EQ(data("A0 00 78 00 40 01 F0 00 FF 00"), (sensor::Blob{255, 0, 0, 319, 239, {1'595}, {1'195}, 0, {}}));
  // 1 x 3, and 1 x 1 in the last corner.
  EXPECT_EQ(data("0A 00 05 00 01 00 03 00 07 00"), (sensor::Blob{7, 10, 4, 10, 6, {100}, {50}, 0, {}}));
  EXPECT_EQ(data("3F 01 EF 00 01 00 01 00 07 00"), (sensor::Blob{7, 319, 239, 319, 239, {3'190}, {2'390}, 0, {}}));
  for (const char* beside : {"40 01 78 00 01 00 28 00 01 00", "A0 00 F0 00 3C 00 01 00 01 00",
                             "FF FF 78 00 01 00 28 00 01 00", "A0 00 FF FF 3C 00 01 00 01 00"}) {
    EXPECT_EQ(data(beside), std::nullopt) << beside;
  }
  // 20 x 10 around (2, 238): columns -8 to 11 and rows 233 to 242 are cut off.
  EXPECT_EQ(data("02 00 EE 00 14 00 0A 00 02 00"), (sensor::Blob{2, 0, 233, 11, 239, {55}, {2'360}, 0, {}}));
}

TEST(HuskyLens, RefusesBoxesThatCannotBe) {
  for (const char* text :
       {"A0 00 78 00 00 00 28 00 01 00", "A0 00 78 00 3C 00 00 00 01 00", "A0 00 78 00 3C 00 28 00 00 00",
        "A0 00 78 00 3C 00 28 00 00 01", "90 01 78 00 0A 00 0A 00 01 00", "9C FF 78 00 0A 00 0A 00 01 00"}) {
    EXPECT_EQ(blob_of(hex(text)), std::nullopt) << text;
  }
}

TEST(HuskyLens, KnocksChoosesColoursAndAsksForBlocks) {
  Talk talk;
  EXPECT_EQ(talk.session.link(), LinkState::kSilent);
  talk.start();
  EXPECT_EQ(talk.session.link(), LinkState::kUnready);
  const Time asked = talk.now;
  const auto frames = talk.hears(kInfo8 + kBlock);
  ASSERT_EQ(frames.size(), 1U);
  ASSERT_EQ(frames[0].blobs.size(), 1U);
  EXPECT_EQ(frames[0].blobs[0], kBox);
  EXPECT_EQ(frames[0].t, asked + milliseconds(1)) << "the first byte of the answer";
  EXPECT_EQ(talk.session.link(), LinkState::kOk);
  EXPECT_EQ(talk.asks(), kAskBlocks);
}

TEST(HuskyLens, AnImageIsGivenOnce) {
  Talk talk;
  talk.start();
  EXPECT_EQ(talk.hears(kInfo8 + kBlock).size(), 1U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(talk.asks(), kAskBlocks);
    EXPECT_TRUE(talk.hears(kInfo8 + kBlock).empty());
    talk.wait(5);
  }
  EXPECT_EQ(talk.session.counts().stale, 3U);
  EXPECT_EQ(talk.asks(), kAskBlocks);
  EXPECT_EQ(talk.hears(kInfo9 + kBlock).size(), 1U);
  EXPECT_EQ(talk.session.link(), LinkState::kOk);
  talk.wait(2'500);
  EXPECT_EQ(talk.asks(), kAskBlocks);
  talk.hears(kInfo9 + kBlock);
  EXPECT_EQ(talk.session.link(), LinkState::kUnready) << "its counter stands still";
}

TEST(HuskyLens, ArrowsAndBlocksWithoutIdAreNoBlobs) {
  Talk talk;
  talk.start();
  const auto frames = talk.hears(hex("55 AA 11 0A 29 02 00 01 00 08 00 00 00 00 00 4E") + kArrow +
                                 hex("55 AA 11 0A 2A A0 00 78 00 3C 00 28 00 00 00 C0"));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_TRUE(frames[0].blobs.empty());
  EXPECT_EQ(talk.session.counts().not_learned, 1U);
  EXPECT_EQ(talk.session.link(), LinkState::kEmpty);
}

TEST(HuskyLens, TellsWhyItSeesNothing) {
  Talk talk;
  talk.start();
  EXPECT_EQ(talk.hears(kNone9).size(), 1U);
  EXPECT_EQ(talk.session.link(), LinkState::kEmpty);
  Talk untaught;
  untaught.start();
  untaught.hears(kUntaught);
  EXPECT_EQ(untaught.session.link(), LinkState::kUnready) << "it has learned no colour";
  Talk busy;
  busy.start();
  busy.hears(kBusy);
  EXPECT_EQ(busy.session.link(), LinkState::kUnready);
  EXPECT_EQ(busy.asks(), Bytes{}) << "not at once";
  busy.wait(50);
  EXPECT_EQ(busy.asks(), kAskBlocks);
}

// A damaged answer is not waited for; 20 ms later it asks again.
TEST(HuskyLens, ADamagedAnswerIsAskedForAgain) {
  Talk talk;
  talk.start();
  Bytes damaged = kInfo8;
  damaged.back() ^= 1U;
  EXPECT_TRUE(talk.hears(damaged).empty());
  EXPECT_EQ(talk.session.counts().broken, 1U);
  EXPECT_EQ(talk.asks(), Bytes{});
  talk.wait(19);
  EXPECT_EQ(talk.asks(), Bytes{});
  talk.wait(1);
  EXPECT_EQ(talk.asks(), kAskBlocks);
}

// Four lost answers, one that comes, four lost again: it has not gone.
TEST(HuskyLens, LostAnswersInARowCount) {
  Talk talk;
  talk.start();
  for (int rounds = 0; rounds < 3; ++rounds) {
    for (int lost = 0; lost < 4; ++lost) {
      talk.wait(100);
      EXPECT_EQ(talk.asks(), kAskBlocks) << rounds << ' ' << lost;
    }
    talk.hears(kBusy);
    talk.wait(50);
    EXPECT_EQ(talk.asks(), kAskBlocks) << rounds;
  }
  EXPECT_EQ(talk.session.counts().restarts, 0U);
}

TEST(HuskyLens, CountsItsFrames) {
  Talk talk;
  talk.start();
  const auto first = talk.hears(kInfo8 + kBlock);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].frame, 0U);
  EXPECT_EQ(talk.asks(), kAskBlocks);
  const auto second = talk.hears(kInfo9 + kBlock);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].frame, 1U);
  EXPECT_EQ(talk.session.counts().frames, 2U);
}

// A header of five bytes, whose command is none.
TEST(HuskyLens, WhatItsFirstBytesAre) {
  using wire::Front;
  const auto front = [](const char* text) { return examine(hex(text)).front; };
  EXPECT_EQ(front("55"), Front::kIncomplete);
  EXPECT_EQ(front("54"), Front::kNoise);
  EXPECT_EQ(front("55 AB"), Front::kNoise);
  EXPECT_EQ(front("55 AA 11 00"), Front::kIncomplete);
  EXPECT_EQ(front("55 AA 11 00 FF"), Front::kNoise) << "seen with the fifth byte";
  EXPECT_EQ(front("55 AA 11 00 3D"), Front::kIncomplete);
  EXPECT_EQ(front("55 AA 11 01 3D"), Front::kNoise) << "one without data";
  EXPECT_EQ(front("55 AA 11 09 29"), Front::kNoise);
  EXPECT_EQ(front("55 AA 11 0A 29"), Front::kIncomplete);
  EXPECT_EQ(front("55 AA 11 0B 29"), Front::kNoise);
  EXPECT_EQ(front("55 AA 42 05 09"), Front::kNoise);
  EXPECT_EQ(front("55 AA 42 05 0A"), Front::kIncomplete);
  EXPECT_EQ(examine(kOk).size, kOk.size());
}

// Five answers that do not come, 100 ms each: it knocks again.
TEST(HuskyLens, BeginsAnewAfterFiveLostAnswers) {
  Talk talk;
  talk.start();
  for (int lost = 0; lost < 4; ++lost) {
    talk.wait(100);
    EXPECT_EQ(talk.asks(), kAskBlocks) << lost;
  }
  talk.wait(99);
  EXPECT_EQ(talk.asks(), Bytes{});
  talk.wait(1);
  EXPECT_EQ(talk.asks(), kKnock);
  EXPECT_EQ(talk.session.link(), LinkState::kSilent);
  EXPECT_EQ(talk.session.counts().timeouts, 5U);
}

// Bytes of the vendor's library; the sums are those of the bytes before them.

const Bytes kKnock2 = hex("55 AA 20 00 0A 00 00 00 00 00 00 00 00 00 00 29");
const Bytes kColour2 = hex("55 AA 30 00 0A 05 00 00 00 00 00 00 00 00 00 3E");
const Bytes kAskBlocks2 = hex("55 AA 21 05 00 25");
const Bytes kOk2 = hex("55 AA 40 00 0A 00 00 00 00 00 00 00 00 00 00 49");
const Bytes kInfo2 = hex("55 AA 42 05 0A 01 00 01 00 01 00 01 00 01 00 55");
// 60 x 40 around (160, 120) of 640 x 480, id 1, confidence 90, "Color1", no content.
const Bytes kBlock2 = hex("55 AA 43 05 12 01 5A A0 00 78 00 3C 00 28 00 06 43 6F 6C 6F 72 31 00 66");

const Bytes kRefused2 = hex("55 AA 41 05 0A 00 00 00 00 00 00 00 00 00 00 4F");

/// To the first question for blocks, which is answered.
std::vector<sensor::BlobFrame> start_two(Talk& talk) {
  EXPECT_EQ(talk.asks(), kKnock2);
  talk.hears(kOk2);
  EXPECT_EQ(talk.asks(), kColour2);
  talk.hears(kOk2);
  EXPECT_EQ(talk.asks(), kAskBlocks2);
  return talk.hears(kInfo2 + kBlock2);
}

TEST(HuskyLens2, IsAskedInItsOwnWords) {
  Talk talk{Session{Options{.generation = Generation::kTwo}}};
  const auto frames = start_two(talk);
  ASSERT_EQ(frames.size(), 1U);
  ASSERT_EQ(frames[0].blobs.size(), 1U);
  EXPECT_EQ(frames[0].blobs[0], kBox) << "in the image of 640 x 480";
  EXPECT_EQ(talk.session.link(), LinkState::kOk);
  EXPECT_EQ(talk.asks(), Bytes{}) << "30 images a second, and it does not count them";
  talk.wait(30);
  EXPECT_EQ(talk.asks(), kAskBlocks2);
  EXPECT_EQ(talk.hears(kInfo2 + kBlock2).size(), 1U);
}

TEST(HuskyLens2, IsFoundWhereAHuskyLens1WasNamed) {
  Talk talk;
  for (int knock = 0; knock < 5; ++knock) {
    EXPECT_EQ(talk.asks(), kKnock);
    talk.wait(100);
  }
  const auto frames = start_two(talk);
  ASSERT_EQ(frames.size(), 1U);
  ASSERT_EQ(frames[0].blobs.size(), 1U);
  // Columns 130 to 189 of 640 are 65 to 94 of 320, rows 100 to 139 are 50 to 69.
  EXPECT_EQ(frames[0].blobs[0], (sensor::Blob{1, 65, 50, 94, 69, {795}, {595}, 0, {}}));
  EXPECT_EQ(talk.session.generation(), Generation::kTwo);
}

TEST(HuskyLens2, AHuskyLens1IsFoundWhereItWasNamed) {
  Talk talk{Session{Options{.generation = Generation::kTwo}}};
  for (int knock = 0; knock < 5; ++knock) {
    EXPECT_EQ(talk.asks(), kKnock2);
    talk.wait(100);
  }
  talk.start();
  const auto frames = talk.hears(kInfo8 + kBlock);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].blobs[0], (sensor::Blob{1, 260, 200, 379, 279, {3'195}, {2'395}, 0, {}}));
}

// It was switched off and on while the loop was busy, and remembers none of its settings.
TEST(HuskyLens2, SwitchedOffAndOnUnnoticedItIsToldItsAlgorithmAnew) {
  fake::SteppedClock clock;
  emulate::HuskyLens2 device(clock.now());
  test::Cable<emulate::HuskyLens2> cable(device, clock);
  Camera<test::Cable<emulate::HuskyLens2>> driver(cable, {.generation = Generation::kTwo});
  device.show({kBox});
  const auto run = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      clock.advance(milliseconds(1));
      static_cast<void>(driver.poll(clock.now()));
    }
  };
  run(3'000);
  ASSERT_EQ(driver.link(), LinkState::kOk);
  static_cast<void>(device.power_up(clock.now()));
  cable.forget();
  clock.advance(milliseconds(1'500));
  run(500);
  EXPECT_EQ(driver.link(), LinkState::kUnready) << "it refuses";
  run(1'500);
  EXPECT_EQ(driver.link(), LinkState::kOk);
  EXPECT_EQ(driver.session().counts().busy, 20U);
}

// One that is busy for less than that is not disturbed.
TEST(HuskyLens2, NineteenRefusalsAreWaitedFor) {
  Talk talk{Session{Options{.generation = Generation::kTwo}}};
  ASSERT_EQ(start_two(talk).size(), 1U);
  talk.wait(30);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 19; ++i) {
      ASSERT_EQ(talk.asks(), kAskBlocks2) << i;
      talk.hears(kRefused2);
      talk.wait(50);
    }
    ASSERT_EQ(talk.asks(), kAskBlocks2);
    EXPECT_EQ(talk.hears(kInfo2 + kBlock2).size(), 1U);
    talk.wait(30);
  }
  EXPECT_EQ(talk.session.counts().restarts, 0U);
}

// Its own second, then at worst five knocks of the other kind and three that those swallow.
TEST(HuskyLens2, ComesBackWithinASecondOfItsStart) {
  for (int phase = 0; phase < 1'000; phase += 50) {
    for (const Generation named : {Generation::kOne, Generation::kTwo}) {
      fake::SteppedClock clock;
      emulate::HuskyLens2 device(clock.now());
      test::Cable<emulate::HuskyLens2> cable(device, clock);
      Camera<test::Cable<emulate::HuskyLens2>> driver(cable, {.generation = named});
      device.show({kBox});
      const auto run = [&](int ms) {
        for (int i = 0; i < ms; ++i) {
          clock.advance(milliseconds(1));
          static_cast<void>(driver.poll(clock.now()));
        }
      };
      run(3'000 + phase);
      ASSERT_EQ(driver.link(), LinkState::kOk) << phase;
      static_cast<void>(device.power_up(clock.now()));
      cable.forget();
      run(2'000);
      EXPECT_EQ(driver.link(), LinkState::kOk) << phase;
    }
  }
}

/// On the two-wire bus: what it has to say is read in portions, and filler where it has nothing.
class OnTwoWires final : public emulate::I2cDevice {
 public:
  explicit OnTwoWires(emulate::HuskyLens& camera) : camera_(camera) {}
  std::optional<Bytes> transfer(std::uint8_t address, const Bytes& out, std::size_t expected, Time now) override {
    if (address != 0x32) return std::nullopt;
    for (const std::uint8_t byte : out) {
      for (const std::uint8_t said : camera_.take(byte, now)) waiting_.push_back(said);
    }
    Bytes in;
    while (in.size() < expected) {
      in.push_back(waiting_.empty() ? 0xFF : waiting_.front());
      if (!waiting_.empty()) waiting_.pop_front();
    }
    return in;
  }

 private:
  emulate::HuskyLens& camera_;
  std::deque<std::uint8_t> waiting_;
};

TEST(HuskyLens, SeesOverI2cWhatItSeesOverSerial) {
  const std::vector<sensor::Blob> scene = {kBox, {2, 10, 20, 30, 50, {200}, {350}, 0, {}}};
  fake::SteppedClock clock;
  emulate::HuskyLens camera;
  OnTwoWires wires(camera);
  test::I2cCable bus(wires, clock);
  wire::I2cStream<test::I2cCable> stream(bus, kAddress);
  Camera<wire::I2cStream<test::I2cCable>> driver(stream);
  std::size_t frames = 0;
  for (int ms = 0; ms < 3'000; ++ms) {
    clock.advance(milliseconds(1));
    if (ms % 33 == 0) camera.show(scene);
    const auto frame = driver.poll(clock.now());
    if (!frame) continue;
    ++frames;
    ASSERT_EQ(frame->blobs.size(), 2U);
    EXPECT_EQ(frame->blobs[0], scene[0]);
    EXPECT_EQ(frame->blobs[1], scene[1]);
  }
  EXPECT_GT(frames, 30U) << "of two seconds";
  EXPECT_LE(bus.longest_read(), 16U);
}

}  // namespace
}  // namespace fencepost::huskylens
