// The v5's pump, against an emulated camera and against bytes.
#include "drivers/nxtcam/v5_camera.hpp"

#include <gtest/gtest.h>

#include "hal/fake/scripted_link.hpp"
#include "tests/drivers/bench/nxtcam5_rig.hpp"
#include "tests/drivers/hex.hpp"

namespace fencepost::nxtcam {
namespace {

using sensor::LinkState;
using test::bytes_of;
using test::hex;
using V5Bench = test::Bench<test::NxtCam5Rig>;
using Script = fake::ScriptedLink<512>;

static_assert(sensor::BlobCamera<V5Camera<V5Bench::Link>>);

const sensor::Blob kV5Red{2, 100, 60, 139, 89, {1195}, {745}, 0, {}};
const sensor::Blob kSmall{5, 10, 20, 19, 29, {145}, {245}, 0, {}};

// One byte a millisecond.
struct Reading {
  explicit Reading(const V5Options& options = {}) : session(options) {}
  Reading& bytes(const std::vector<std::uint8_t>& bytes) {
    for (const std::uint8_t byte : bytes) {
      now = now + base::milliseconds(1);
      session.take(byte, now);
      pass(0);
    }
    return *this;
  }
  Reading& pass(std::int64_t ms) {
    for (std::int64_t i = 0; i <= ms; ++i) {
      if (i > 0) now = now + base::milliseconds(1);
      session.step(now);
      if (const auto frame = session.take_frame()) frames.push_back(*frame);
    }
    return *this;
  }
  V5Session session;
  base::Time now{10'000};
  std::vector<sensor::BlobFrame> frames;
};

const std::vector<std::uint8_t> kExample = hex("55 AA 07 04 11 00 02 64 3C 8C 5A A3");

TEST(V5Camera, TheWorkedExampleIsAFrameAfterThePause) {
  Reading reading;
  reading.bytes(kExample);
  EXPECT_TRUE(reading.frames.empty());
  reading.pass(8);
  ASSERT_EQ(reading.frames.size(), 1U);
  ASSERT_EQ(reading.frames[0].blobs.size(), 1U);
  EXPECT_EQ(reading.frames[0].blobs[0], kV5Red);
  EXPECT_EQ(reading.frames[0].t, base::Time{10'010}) << "its first byte";
}

TEST(V5Camera, BlobsOfOneCountAreOneFrameTheLargestFirst) {
  Reading reading;
  reading.bytes(test::NxtCam5::framed(4, {9, 0, 5, 10, 20, 20, 30}));
  reading.bytes(test::NxtCam5::framed(4, {9, 0, 2, 100, 60, 140, 90}));
  reading.bytes(test::NxtCam5::framed(4, {10, 0, 5, 10, 20, 20, 30}));
  ASSERT_EQ(reading.frames.size(), 1U) << "complete with the next one's first blob";
  ASSERT_EQ(reading.frames[0].blobs.size(), 2U);
  EXPECT_EQ(reading.frames[0].blobs[0], kV5Red);
  EXPECT_EQ(reading.frames[0].blobs[1], kSmall);
  reading.pass(8);
  EXPECT_EQ(reading.frames.size(), 2U);
}

TEST(V5Camera, ABlobBehindItsFrameIsLate) {
  Reading reading;
  reading.bytes(kExample).pass(28).bytes(kExample).pass(20);
  EXPECT_EQ(reading.frames.size(), 2U) << "a frame's time later: a camera whose count stands still";
  Reading late({.frame_pause = base::milliseconds(3)});
  late.bytes(kExample).pass(3).bytes(kExample).pass(20);
  EXPECT_EQ(late.frames.size(), 1U);
  EXPECT_EQ(late.session.counts().late, 1U);
}

TEST(V5Camera, ABlobThatCannotBeIsRejected) {
  Reading reading;
  reading.bytes(test::NxtCam5::framed(4, {9, 0, 5, 30, 20, 20, 30})).pass(30);
  EXPECT_TRUE(reading.frames.empty());
  EXPECT_EQ(reading.session.counts().rejected, 1U);
  reading.bytes(test::NxtCam5::framed(9, {1, 2, 3})).pass(30);
  EXPECT_EQ(reading.session.counts().unrelated, 1U);
}

TEST(V5Camera, AsksForTheVersionAndCommandsTracking) {
  Script link({});
  V5Camera<Script> camera(link);
  EXPECT_FALSE(camera.poll(base::Time{10}));
  EXPECT_EQ(bytes_of(link.written()), hex("55 AA 00 01 00"));
  const auto version = hex("55 AA 04 01 35 2E 30 31 C8");
  const std::array<fake::LinkStep, 1> script = {{{version, {}}}};
  Script answering(script);
  V5Camera<Script> heard(answering);
  EXPECT_FALSE(heard.poll(base::Time{10}));
  EXPECT_EQ(heard.session().version(), "5.01");
  EXPECT_EQ(bytes_of(answering.written()), hex("55 AA 01 03 45 48 55 AA 00 01 00"));
  EXPECT_EQ(heard.link(), LinkState::kUnready);
}

TEST(V5Camera, LinkStates) {
  V5Bench bench;
  bench.run(1'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent) << "starting";
  bench.run(1'100, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kUnready) << "heard, and nothing seen yet";
  EXPECT_TRUE(bench.frames.empty());
  bench.run(1'500, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
  ASSERT_FALSE(bench.frames.empty());
  EXPECT_TRUE(bench.frames.back().blobs.empty());
  bench.run(100, {kV5Red, kSmall});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  ASSERT_EQ(bench.frames.back().blobs.size(), 2U);
  EXPECT_EQ(bench.frames.back().blobs[0], kV5Red);
  EXPECT_EQ(bench.frames.back().blobs[1], kSmall);
  bench.link.unplug();
  bench.run(10, {kV5Red});
  EXPECT_EQ(bench.driver.link(), LinkState::kAbsent);
  bench.link.replug();
  bench.run(1'500, {kV5Red});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  EXPECT_EQ(bench.driver.session().version(), "5.01");
}

// A camera that takes no questions: heard by its blobs alone.
TEST(V5Camera, OneThatAnswersNothingIsSilentWithoutBlobs) {
  V5Bench bench;
  bench.device.set_answers(false);
  bench.restart(bench.clock.now());
  bench.run(3'000, {kV5Red});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  bench.run(3'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent);
  for (const auto& frame : bench.frames) EXPECT_FALSE(frame.blobs.empty());
}

TEST(V5Camera, OrEmptyIfSoTold) {
  V5Bench bench(test::Damage{}, V5Options{.ask = false, .silence_is_empty = true});
  bench.device.set_answers(false);
  bench.restart(bench.clock.now());
  bench.run(5'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kSilent) << "never heard";
  bench.run(1'000, {kV5Red});
  EXPECT_EQ(bench.driver.link(), LinkState::kOk);
  bench.run(5'000, {});
  EXPECT_EQ(bench.driver.link(), LinkState::kEmpty);
  EXPECT_EQ(bench.run(1'000).size(), 10U) << "a frame without blobs each 100 ms";
}

}  // namespace
}  // namespace fencepost::nxtcam
