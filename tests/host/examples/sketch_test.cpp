// The Arduino's example, compiled as it is, on an Arduino of the test's.
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "firmware/record/encode.hpp"
#include "tests/host/examples/arduino.hpp"

namespace fencepost::host::arduino {
#include "host/share/examples/stop_motors.ino"  // NOLINT(bugprone-suspicious-include): that is what it is
}  // namespace fencepost::host::arduino

namespace fencepost::host::arduino {
namespace {

using record::AlertLevel;
using sensor::LinkState;

/// The robot at its console, and the motors: they turn from and to.
class Sketch : public ::testing::Test {
 protected:
  Sketch() {
    pins = {};
    Serial1 = {};
    heard = asked = 0;
    may = false;
    line = {};
    setup();
    EXPECT_EQ(pins.modes, (std::map<int, int>{{5, OUTPUT}, {6, OUTPUT}}));
  }

  void say(const std::string& text) { Serial1.waiting.insert(Serial1.waiting.end(), text.begin(), text.end()); }
  void say(const record::Heartbeat& beat) {
    std::array<char, record::kMaxLine> text{};
    say(std::string(text.data(), record::encode(beat, text)));
  }
  void run(unsigned long ms) {
    for (const unsigned long end = pins.now + ms; pins.now < end; ++pins.now) {
      loop();
      EXPECT_EQ(pins.duty[5], pins.duty[6]) << "both alike";
      if (turning() != turned_) changes_.push_back(pins.now);
      turned_ = turning();
    }
  }
  void beat_for(unsigned long ms, AlertLevel level = AlertLevel::kWarn, LinkState camera = LinkState::kOk,
                LinkState odometry = LinkState::kOk) {
    for (const unsigned long end = pins.now + ms; pins.now < end;) {
      say(record::Heartbeat{base::Time::nearest(0.001 * static_cast<double>(pins.now)), level, camera, odometry});
      run(100);
    }
  }
  [[nodiscard]] static bool turning() { return pins.duty[5] > 0; }
  /// When they began and ended to turn, in turn.
  [[nodiscard]] const std::vector<unsigned long>& changes() const { return changes_; }

 private:
  bool turned_ = false;
  std::vector<unsigned long> changes_;
};

TEST_F(Sketch, TurnsWhileTheHeartbeatComes) {
  run(500);
  EXPECT_FALSE(turning());
  beat_for(2'000);
  EXPECT_TRUE(turning());
  EXPECT_EQ(changes().size(), 1U);
}

TEST_F(Sketch, SilenceStopsThem) {
  beat_for(1'000);
  const unsigned long last = pins.now - 100;
  run(1'000);
  ASSERT_EQ(changes().size(), 2U);
  EXPECT_GE(changes()[1] - last, 290U);
  EXPECT_LE(changes()[1] - last, 310U);
}

TEST_F(Sketch, StopBlindAndAMissingSensorStopThemAtOnce) {
  const std::tuple<AlertLevel, LinkState, LinkState> kReasons[] = {
      {AlertLevel::kStop, LinkState::kOk, LinkState::kOk},
      {AlertLevel::kBlind, LinkState::kOk, LinkState::kOk},
      {AlertLevel::kClear, LinkState::kSilent, LinkState::kOk},
      {AlertLevel::kClear, LinkState::kOk, LinkState::kSilent},
      {AlertLevel::kClear, LinkState::kAbsent, LinkState::kOk},
      {AlertLevel::kClear, LinkState::kUnready, LinkState::kOk}};
  for (const auto& [level, camera, odometry] : kReasons) {
    beat_for(500);
    ASSERT_TRUE(turning());
    say(record::Heartbeat{{}, level, camera, odometry});
    run(2);
    EXPECT_FALSE(turning()) << name(level) << name(camera) << name(odometry);
    beat_for(500, level, camera, odometry);
    EXPECT_FALSE(turning());
  }
}

TEST_F(Sketch, AnEmptyViewIsNoFault) {
  beat_for(500, AlertLevel::kClear, LinkState::kEmpty);
  EXPECT_TRUE(turning());
}

TEST_F(Sketch, OtherLinesAreNoHeartbeat) {
  beat_for(500);
  for (int i = 0; i < 20; ++i) {
    say("$FPODO,1.0000,0.0000,0.0000,0.0000*0000\r\nREADY\r\n" + std::string(500, 'x') + "$FPALV,");
    run(50);
  }
  EXPECT_FALSE(turning());
  say("\r\n");
  beat_for(200);
  EXPECT_TRUE(turning()) << "and it finds its way back";
}

TEST_F(Sketch, AsksForTheHeartbeat) {
  run(3'500);
  ASSERT_GE(Serial1.written.size(), 2U);
  EXPECT_EQ(Serial1.written[0].second, "\rmode log\r");
  const std::size_t asked_so_far = Serial1.written.size();
  beat_for(3'000);
  EXPECT_LE(Serial1.written.size(), asked_so_far + 1);
}

TEST_F(Sketch, HasTwentyLinesAtMost) {
  std::ifstream file(FENCEPOST_SOURCE_DIR "/host/share/examples/stop_motors.ino");
  int lines = 0;
  for (std::string text; std::getline(file, text);) ++lines;
  EXPECT_GT(lines, 5);
  EXPECT_LE(lines, 20);
}

}  // namespace
}  // namespace fencepost::host::arduino
