// The alert as a CAN frame. can_alert_frames and dbc_check.py hold the same bytes against the DBC file.
#include "host/live/can_alert.hpp"

#include <gtest/gtest.h>

namespace fencepost::host {
namespace {

using record::AlertLevel;
using sensor::LinkState;
using Bytes = std::array<std::uint8_t, 8>;

AlertNow stop() {
  AlertNow alert;
  alert.beat = {base::Time::nearest(3), AlertLevel::kStop, LinkState::kEmpty, LinkState::kOk};
  alert.of.emplace();
  alert.of->id = 5;
  alert.of->distance = base::Metres::nearest(0.2704);
  alert.of->bearing = base::Radians::nearest(-0.0526);
  alert.of->ttc = base::Duration::nearest(0.94);
  return alert;
}

TEST(CanAlert, AFrameByHand) {
  // Level 3, may not move, camera 3: 0x33. 270 mm = 0x010E, -53 mrad = 0xFFCB, 0.9 s = 9.
  const bus::CanFrame frame = alert_frame({"can0", 0x120, false}, stop(), 0xA7);
  EXPECT_EQ(frame.id, 0x120U);
  EXPECT_FALSE(frame.extended);
  EXPECT_EQ(frame.length, 8);
  EXPECT_EQ(frame.data, (Bytes{0x33, 0x04, 0x0E, 0x01, 0xCB, 0xFF, 0x09, 0xA7}));
}

TEST(CanAlert, WhatIsNotKnownAndWhatDoesNotFit) {
  AlertNow clear;
  clear.beat = {{}, AlertLevel::kClear, LinkState::kOk, LinkState::kOk};
  clear.may_move = true;
  EXPECT_EQ(alert_frame({}, clear, 0).data, (Bytes{0x48, 0xFC, 0xFF, 0xFF, 0x00, 0x80, 0xFF, 0x00}));
  EXPECT_EQ(alert_frame({}, {}, 1).data, (Bytes{0x04, 0x00, 0xFF, 0xFF, 0x00, 0x80, 0xFF, 0x01})) << "blind, absent";
  AlertNow far = stop();
  far.of->distance = base::Metres::nearest(999);
  far.of->bearing = base::Radians::nearest(-99);
  far.of->ttc = base::Duration::nearest(300);
  const Bytes data = alert_frame({}, far, 0).data;
  EXPECT_EQ((std::array{data[2], data[3]}), (std::array<std::uint8_t, 2>{0xFE, 0xFF})) << "65.534 m";
  EXPECT_EQ((std::array{data[4], data[5]}), (std::array<std::uint8_t, 2>{0x01, 0x80})) << "-32.767 rad";
  EXPECT_EQ(data[6], 254) << "25.4 s";
}

// In steps of 0.05 m/s behind the three bits of the odometry, never more than may be driven.
TEST(CanAlert, TheSpeedLimitIsRoundedDown) {
  const auto steps = [](double speed, bool may_move = true) {
    AlertNow alert;
    alert.beat = {{}, AlertLevel::kWarn, LinkState::kOk, LinkState::kOk};
    alert.may_move = may_move;
    alert.speed_limit.speed = base::Metres::nearest(speed);
    const std::uint8_t byte = alert_frame({}, alert, 0).data[1];
    EXPECT_EQ(byte & 7, 4) << "odometry as before";
    return byte >> 3;
  };
  EXPECT_EQ(steps(0), 0);
  EXPECT_EQ(steps(0.0499), 0);
  EXPECT_EQ(steps(0.05), 1);
  EXPECT_EQ(steps(0.3499), 6);
  EXPECT_EQ(steps(1.5), 30);
  EXPECT_EQ(steps(4), 30);
  EXPECT_EQ(steps(0.35, false), 0);
}

TEST(CanAlert, ReadsWhatTheCommandLineSays) {
  const auto plain = parse_can_alert("can0");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->interface, "can0");
  EXPECT_EQ(plain->id, 0x120U);
  const auto shorter = parse_can_alert("vcan1:7FF");
  ASSERT_TRUE(shorter.ok());
  EXPECT_EQ(shorter->id, 0x7FFU);
  EXPECT_FALSE(shorter->extended);
  const auto longer = parse_can_alert("can0:00000120");
  ASSERT_TRUE(longer.ok());
  EXPECT_TRUE(longer->extended);
  EXPECT_EQ(longer->id, 0x120U);
  for (const char* wrong : {"", ":120", "can0:", "can0:12", "can0:0x120", "can0:800", "can0:2FFFFFFF", "can0:12G"}) {
    EXPECT_FALSE(parse_can_alert(wrong).ok()) << wrong;
  }
}

/// A bus that the test stops and looks at.
struct Wire {
  std::vector<bus::CanFrame> frames;
  bool works = true;
};
class WireEnd final : public FrameSink {
 public:
  explicit WireEnd(Wire& wire) : wire_(wire) {}
  bool send(const bus::CanFrame& frame) override {
    if (wire_.works) wire_.frames.push_back(frame);
    return wire_.works;
  }
  void tend(base::Time) override {}
  [[nodiscard]] std::string problem() const override { return wire_.works ? "" : "the bus is off"; }

 private:
  Wire& wire_;
};

TEST(CanAlert, SendsAtOnceWhatChangesAndOtherwiseInTime) {
  Wire wire;
  CanAlert output({}, std::make_unique<WireEnd>(wire));
  base::Time now;
  AlertNow alert = stop();
  const auto turn = [&] { output.show(alert, now = now + base::milliseconds(1)); };
  turn();
  ASSERT_EQ(wire.frames.size(), 1U);
  for (int i = 0; i < 1'000; ++i) {
    alert.of->distance.raw += 10;  // changes all the time, and is no reason
    turn();
  }
  EXPECT_GE(wire.frames.size(), 11U) << "at least every 100 ms";
  EXPECT_LE(wire.frames.size(), 30U) << "and no flood";
  for (std::size_t i = 0; i < wire.frames.size(); ++i) EXPECT_EQ(wire.frames[i].data[7], i) << "counted";
  const auto changes = [&](auto change) {
    const std::size_t before = wire.frames.size();
    change();
    turn();
    return wire.frames.size() == before + 1;
  };
  turn();
  EXPECT_TRUE(changes([&] { alert.beat.level = AlertLevel::kWarn; }));
  EXPECT_TRUE(changes([&] { alert.may_move = true; }));
  EXPECT_TRUE(changes([&] { alert.beat.camera = LinkState::kSilent; }));
  EXPECT_TRUE(changes([&] { alert.beat.odometry = LinkState::kSilent; }));
  EXPECT_TRUE(changes([&] { alert.of->id = 6; }));
  EXPECT_FALSE(changes([] {})) << "it can fail";
  output.end(now);
  EXPECT_EQ(wire.frames.back().data[0], 0x04) << "blind, and not to move";
}

TEST(CanAlert, SaysOnceThatTheBusDoesNotWorkAndThatItDoesAgain) {
  Wire wire;
  CanAlert output({}, std::make_unique<WireEnd>(wire));
  wire.works = false;
  std::vector<std::string> said;
  const auto turns = [&](int from) {
    for (int i = from; i < from + 5; ++i) {
      output.show(stop(), base::Time{} + base::milliseconds(i));
      for (const std::string& sentence : output.messages()) said.push_back(sentence);
    }
  };
  turns(0);
  wire.works = true;
  turns(5);
  ASSERT_EQ(said.size(), 2U);
  EXPECT_EQ(said[0], "the bus is off; the run goes on");
  EXPECT_EQ(wire.frames.size(), 1U) << "at once when it works again";
}

}  // namespace
}  // namespace fencepost::host
