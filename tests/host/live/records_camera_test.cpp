#include "host/live/records_camera.hpp"

#include <gtest/gtest.h>

#include <string>

#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::host {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;

static_assert(serial::Session<FramesSession>);
static_assert(sensor::BlobCamera<serial::Pump<serial::LinkArchetype, FramesSession>>);

Time at(std::int64_t ms) { return Time{} + milliseconds(ms); }

// A frame without a blob, as host/share/examples/openmv_frames.py prints it (tests/host/examples/cameras_test.py).
const std::string kNothing = "$FPFRM,5.0400,1,0*8C3E\r\n";
// A frame with one blob, as the same example prints it.
const std::string kOne = "$FPFRM,5.0800,2,1,1,168,66,231,113,200.4,89.5,2500,*2653\r\n";
constexpr sensor::Blob kBlob{1, 168, 66, 231, 113, {2'004}, {895}, 2'500, {}};  // of kOne

struct FramesTest : ::testing::Test {
  /// How many frames were complete; a byte a millisecond.
  int feed(const std::string& bytes) {
    int frames = 0;
    for (const char byte : bytes) {
      frames += session.take(static_cast<std::uint8_t>(byte), now) ? 1 : 0;
      session.step(now);
      now = now + milliseconds(1);
    }
    return frames;
  }
  FramesSession session{FramesConfig{}};
  Time now = at(100);
};

TEST_F(FramesTest, AFrameIsOfItsFirstByte) {
  EXPECT_EQ(feed(kOne), 1);
  EXPECT_EQ(session.sample().t, at(100));
  EXPECT_EQ(session.sample().frame, 2U);
  ASSERT_EQ(session.sample().blobs.size(), 1U);
  EXPECT_EQ(session.sample().blobs[0], kBlob);
  EXPECT_EQ(session.link(), LinkState::kOk);
}

TEST_F(FramesTest, WhatIsNoFrameIsPassedOver) {
  std::string damaged = kOne;
  damaged[12] = '9';
  EXPECT_EQ(feed("MicroPython v1.23\r\n>>> \r\n" + damaged + "$FPODO,,0.1,0.2,0.3*C7C6\n"), 0);
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_EQ(feed(std::string(5'000, 'x') + "\n" + kOne), 1);
}

TEST_F(FramesTest, CutInAtAnyByteTheNextFrameIsUnderstood) {
  for (std::size_t cut = 1; cut < kOne.size(); ++cut) {
    EXPECT_EQ(feed(kOne.substr(cut) + kOne), 1) << cut;
    const bool whole = cut == kOne.size() - 1;  // but for its line feed
    EXPECT_EQ(feed(kOne.substr(0, cut) + kOne), whole ? 2 : 1) << cut << ": what was cut off is no part of it";
  }
}

TEST_F(FramesTest, LinkStates) {
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(feed(kNothing), 1);
  EXPECT_EQ(session.link(), LinkState::kEmpty);
  session.step(now + milliseconds(1'100));
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(feed(kOne), 1);
  EXPECT_EQ(session.link(), LinkState::kOk);
  session.link_lost();
  EXPECT_EQ(session.link(), LinkState::kSilent);
}

}  // namespace
}  // namespace fencepost::host
