// The alert in force, as outputs get it.
#include "host/live/alert_now.hpp"

#include <gtest/gtest.h>

#include <array>

#include "firmware/record/encode.hpp"

namespace fencepost::host {
namespace {

using record::AlertLevel;

template <class Record>
std::string line_of(const Record& record) {
  std::array<char, record::kMaxLine> line{};
  const std::size_t size = record::encode(record, line);
  return {line.data(), size};
}

std::string alert_line(AlertLevel level, std::uint32_t id, double distance, std::uint8_t signature = 1) {
  record::AlertReport report;
  report.t = base::Time::nearest(2);
  report.level = level;
  report.id = id;
  report.signature = signature;
  report.distance = base::Metres::nearest(distance);
  report.bearing = base::Radians::nearest(-0.2);
  report.ttc = base::Duration::nearest(1.5);
  return line_of(report);
}

AlertNow in_force(const AlertFollower& follower, AlertLevel level) {
  AlertNow alert;
  alert.beat.level = level;
  follower.complete(alert);
  return alert;
}

TEST(AlertFollower, TellsTheNearestAlertOfTheLevelInForce) {
  AlertFollower follower;
  follower.take(line_of(record::Signature{1, {}, sensor::Text("red")}));
  follower.take(alert_line(AlertLevel::kWarn, 1, 0.6) + alert_line(AlertLevel::kStop, 2, 0.4, 7) +
                alert_line(AlertLevel::kStop, 3, 0.3));
  const AlertNow stop = in_force(follower, AlertLevel::kStop);
  ASSERT_TRUE(stop.of);
  EXPECT_EQ(stop.of->id, 3U);
  EXPECT_EQ(stop.colour, "red");
  follower.take(alert_line(AlertLevel::kClear, 3, 0.9));
  const AlertNow other = in_force(follower, AlertLevel::kStop);
  ASSERT_TRUE(other.of);
  EXPECT_EQ(other.of->id, 2U);
  EXPECT_EQ(other.colour, "7") << "a signature without a name";
  EXPECT_EQ(in_force(follower, AlertLevel::kWarn).of->id, 1U);
  EXPECT_FALSE(in_force(follower, AlertLevel::kNotice).of);
}

TEST(AlertFollower, BlindAndClearHaveNoPlace) {
  AlertFollower follower;
  follower.take(alert_line(AlertLevel::kStop, 0, 0.3) + alert_line(AlertLevel::kBlind, 0, 0));
  EXPECT_FALSE(in_force(follower, AlertLevel::kStop).of) << "it is blind now";
  EXPECT_FALSE(in_force(follower, AlertLevel::kBlind).of);
  follower.take(alert_line(AlertLevel::kClear, 0, 0));
  EXPECT_FALSE(in_force(follower, AlertLevel::kClear).of);
}

TEST(AlertFollower, ANewRunKeepsNothing) {
  AlertFollower follower;
  follower.take(alert_line(AlertLevel::kStop, 4, 0.3));
  follower.take(line_of(record::Header{}));
  EXPECT_FALSE(in_force(follower, AlertLevel::kStop).of);
}

TEST(AlertFollower, PassesOverWhatIsNoAlert) {
  AlertFollower follower;
  const std::string stop = alert_line(AlertLevel::kStop, 4, 0.3);
  std::string damaged = stop;
  damaged[8] = 'X';
  follower.take("READY\r\n" + damaged + "$FPODO,1.0000,0.0000,0.0000,0.0000*0000\r\n$FPALR,\n\n");
  EXPECT_FALSE(in_force(follower, AlertLevel::kStop).of);
  follower.take(stop);
  EXPECT_TRUE(in_force(follower, AlertLevel::kStop).of);
}

}  // namespace
}  // namespace fencepost::host
