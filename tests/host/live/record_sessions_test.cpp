#include "host/live/record_sessions.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "drivers/serial/pump.hpp"
#include "firmware/record/encode.hpp"

namespace fencepost::host {
namespace {

using base::milliseconds;
using base::Time;
using sensor::LinkState;

static_assert(serial::Session<FramesSession>);
static_assert(sensor::BlobCamera<serial::Pump<serial::LinkArchetype, FramesSession>>);
static_assert(serial::Session<RecordsSession>);
static_assert(sensor::OdometrySource<serial::Pump<serial::LinkArchetype, RecordsSession>>);

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

template <class Record>
std::string record_line(const Record& sample) {
  std::array<char, record::kMaxLine> line{};
  return {line.data(), record::encode(sample, line)};
}

class RecordsTest : public testing::Test {
 protected:
  /// How many samples were complete.
  int feed(RecordsSession& session, const std::string& bytes, Time now) {
    int samples = 0;
    for (const char byte : bytes) samples += session.take(static_cast<std::uint8_t>(byte), now) ? 1 : 0;
    session.step(now);
    return samples;
  }
  const sensor::OdometrySample sample{{50'000}, {1'000}, {-2'000}, {3'000}};  // 5 s, 0.1 m, -0.2 m, 0.3 rad
};

TEST_F(RecordsTest, StampsOnArrivalWhateverTheSendersClockSays) {
  RecordsSession session(RecordStamp::kArrival);
  EXPECT_EQ(feed(session, record_line(sample), at(70)), 1);
  EXPECT_EQ(session.sample(), (sensor::OdometrySample{at(70), sample.x, sample.y, sample.heading}));
  EXPECT_EQ(feed(session, record_line(sample), at(90)), 1) << "a sender that starts again, its clock too";
  EXPECT_EQ(session.sample().t, at(90));
}

TEST_F(RecordsTest, KeepsTheSendersTimeIfTold) {
  RecordsSession session(RecordStamp::kOwn);
  EXPECT_EQ(feed(session, record_line(sample), at(70)), 1);
  EXPECT_EQ(session.sample(), sample);
  EXPECT_EQ(feed(session, "$FPODO,,0.1,0.2,0.3*C7C6\n", at(80)), 1);
  EXPECT_EQ(session.sample().t, at(80));
}

TEST_F(RecordsTest, PassesOverWhatIsNoOdometry) {
  RecordsSession session(RecordStamp::kArrival);
  std::string damaged = record_line(sample);
  damaged[8] = '9';
  EXPECT_EQ(feed(session, "boot\r\n\r\n$FPDIG,50,0123456789abcdef*0000\r\n" + damaged, at(0)), 0);
  EXPECT_EQ(session.link(), LinkState::kUnready);
  EXPECT_EQ(feed(session, std::string(5'000, 'x') + "\n" + record_line(sample), at(10)), 1);
  EXPECT_EQ(session.link(), LinkState::kOk);
}

TEST_F(RecordsTest, TakesACarsReadingsIfItKnowsTheCar) {
  const auto reading = [](std::int32_t count) {
    return record_line(sensor::CarSample{{}, count, {}, base::RadiansPerSecond{0}});
  };
  RecordsSession unknown(RecordStamp::kArrival);
  EXPECT_EQ(feed(unknown, reading(0), at(0)), 0);
  EXPECT_EQ(unknown.link(), LinkState::kUnready);
  odometry::CarGeometry car;
  car.pm_per_count = 500'000'000;
  RecordsSession session(host::RecordsConfig(RecordStamp::kArrival, car));
  EXPECT_EQ(feed(session, reading(7) + reading(7), at(0)), 2);
  EXPECT_EQ(feed(session, reading(207), at(100)), 1);
  EXPECT_EQ(session.sample(), (sensor::OdometrySample{at(100), {1'000}, {}, {}})) << "200 counts of 0.5 mm";
  EXPECT_EQ(session.link(), LinkState::kOk);
}

TEST_F(RecordsTest, KnowsHowTheLinkIs) {
  RecordsSession session(RecordStamp::kArrival);
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(feed(session, record_line(sample), at(0)), 1);
  session.step(at(999));
  EXPECT_EQ(session.link(), LinkState::kOk);
  session.step(at(1'000));
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(feed(session, record_line(sample).substr(0, 10), at(1'100)), 0);
  session.link_lost();
  EXPECT_EQ(session.link(), LinkState::kSilent);
  EXPECT_EQ(feed(session, record_line(sample), at(1'200)), 1) << "the half line before the unplug is forgotten";
}

}  // namespace
}  // namespace fencepost::host
