#include "firmware/console/text.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <string>

namespace fencepost::test {
namespace {

using base::Metres;
using base::Radians;

record::AlertReport alert(record::AlertLevel level, double distance, double degrees) {
  record::AlertReport report;
  report.level = level;
  report.id = 7;
  report.signature = 3;
  report.distance = Metres::nearest(distance);
  report.bearing = Radians::nearest(degrees * 3.14159265 / 180);
  return report;
}

std::string sentence(const record::AlertReport& report, std::string_view name) {
  std::array<char, console::kMaxSentence> out{};
  return {out.data(), console::describe(report, name, out)};
}

TEST(Text, IsASentenceThatAPersonUnderstands) {
  record::AlertReport stop = alert(record::AlertLevel::kStop, 0.24, 12);
  EXPECT_EQ(sentence(stop, "red"), "STOP    red  0.24 m  12 deg left\r\n");
  stop.ttc = base::Duration::nearest(1.13);
  EXPECT_EQ(sentence(stop, "red"), "STOP    red  0.24 m  12 deg left  in 1.1 s\r\n");
  EXPECT_EQ(sentence(alert(record::AlertLevel::kWarn, 0.456, -90), "blue"), "WARN    blue  0.46 m  90 deg right\r\n");
  EXPECT_EQ(sentence(alert(record::AlertLevel::kNotice, 1, 0), ""), "NOTICE  signature 3  1.00 m  ahead\r\n");
  EXPECT_EQ(sentence(alert(record::AlertLevel::kClear, 12.3449, 180), "red"), "CLEAR   red  12.34 m  behind\r\n");
}

TEST(Text, WhatIsNoObjectIsSomething) {
  record::AlertReport stop = alert(record::AlertLevel::kStop, 0.24, 0);
  stop.id = record::kNoObject;
  EXPECT_EQ(sentence(stop, "red"), "STOP    something red  0.24 m  ahead\r\n");
  EXPECT_EQ(sentence(stop, ""), "STOP    something  0.24 m  ahead\r\n");
}

TEST(Text, RoundsTheBearingToDegrees) {
  EXPECT_NE(sentence(alert(record::AlertLevel::kStop, 1, 2.49), "x").find("ahead"), std::string::npos);
  EXPECT_NE(sentence(alert(record::AlertLevel::kStop, 1, 2.51), "x").find("3 deg left"), std::string::npos);
}

TEST(Text, BlindIsSaidWithItsReasonAndClearedInWords) {
  std::array<char, console::kMaxSentence> out{};
  const std::size_t size = console::describe_blind(alert::Blindness::kCameraLate, out);
  EXPECT_EQ(std::string(out.data(), size), "BLIND   no frame comes from the camera\r\n");
  record::AlertReport report;
  report.level = record::AlertLevel::kBlind;
  EXPECT_EQ(sentence(report, ""), "BLIND   what is ahead cannot be known\r\n");
  report.level = record::AlertLevel::kClear;
  EXPECT_EQ(sentence(report, ""), "CLEAR   it sees again\r\n");
}

std::string plot(const std::optional<console::Nearest>& nearest, record::AlertLevel level,
                 record::Doubt doubt = record::Doubt::kNone) {
  std::array<char, console::kMaxSentence> out{};
  const record::Heartbeat beat{{}, level, sensor::LinkState::kSilent, sensor::LinkState::kOk};
  return {out.data(), console::describe_plot(nearest, beat, doubt, out)};
}

TEST(Text, PlotLinesAreNamesAndNumbers) {
  const console::Nearest right{Metres::nearest(0.834), Radians::nearest(-0.21)};
  EXPECT_EQ(plot(right, record::AlertLevel::kWarn), "dist_cm:83,bear_deg:-12,level:2,camera:1,odometry:4\r\n");
  EXPECT_EQ(plot(std::nullopt, record::AlertLevel::kClear), "level:0,camera:1,odometry:4\r\n");
}

TEST(Text, PlotLinesTellOfADoubtAboutTheCameraWhileThereIsOne) {
  EXPECT_EQ(plot(std::nullopt, record::AlertLevel::kClear, record::Doubt::kLens),
            "level:0,camera:1,odometry:4,doubt:2\r\n");
}

TEST(Text, ADoubtAboutTheCameraSaysWhatToCheck) {
  std::array<char, console::kMaxSentence> out{};
  const auto said = [&](record::Doubt doubt, std::int32_t factor) {
    return std::string(out.data(), console::describe(record::CalibrationDoubt{{}, doubt, {factor}}, out));
  };
  EXPECT_EQ(said(record::Doubt::kRows, 131),
            "CAMERA  check the camera's pitch and height: things are 1.31 times nearer than it tells\r\n");
  EXPECT_EQ(said(record::Doubt::kRows, 80),
            "CAMERA  check the camera's pitch and height: things are 1.25 times farther than it tells\r\n");
  EXPECT_EQ(said(record::Doubt::kLens, 145),
            "CAMERA  check the focal length, or the wheels' track: the lens seems configured 1.45 times too long\r\n");
  EXPECT_EQ(
      said(record::Doubt::kLens, 1),
      "CAMERA  check the focal length, or the wheels' track: the lens seems configured 100.00 times too short\r\n");
  EXPECT_EQ(said(record::Doubt::kNone, 100), "CAMERA  nothing speaks against its calibration any more\r\n");
}

TEST(Text, ARejectedRecordIsNamedWithTheReason) {
  std::array<char, console::kMaxSentence> out{};
  const auto said = [&](std::string_view line, record::Reject reason) {
    return std::string(out.data(), console::describe_reject(line, reason, {}, out));
  };
  EXPECT_EQ(said("$FPODO,1,2,3", record::Reject::kCrc),
            "error: $FPODO rejected (crc): the checksum is missing or wrong\r\n");
  EXPECT_EQ(said("$FP\x01this is no record at all", record::Reject::kKind),
            "error: $FP?this is no.. rejected (kind): there is no such record\r\n");
}

TEST(Text, TheLongestSentenceFits) {
  record::AlertReport stop = alert(record::AlertLevel::kStop, 999.99, -179);
  stop.bearing = Radians::nearest(-3.0);
  stop.ttc = base::Duration::nearest(999.9);
  const std::string name(sensor::kMaxText, 'x');
  EXPECT_GT(sentence(stop, name).size(), 60U);
  std::array<char, 20> little{};
  EXPECT_EQ(console::describe(stop, name, little), 0U);
}

}  // namespace
}  // namespace fencepost::test
