// Positions end at 1000 m, in the log as in the robot: what is beyond is rejected, counted and said, in every mode
// alike.
#include <gtest/gtest.h>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

sensor::OdometrySample at(double t, std::int32_t x, std::int32_t y = 0, std::int32_t heading = 0) {
  return {base::Time::nearest(t), {x}, {y}, {heading}};
}

TEST(OdometryRange, EndsAtAThousandMetresAndRadians) {
  constexpr std::int32_t kEdge = 10'000'000;
  Desk<> desk;
  const auto accept = [&](const sensor::OdometrySample& sample) { return desk.pipeline().accept(sample); };
  EXPECT_EQ(accept(at(1, kEdge, -kEdge, kEdge)), std::nullopt);
  EXPECT_EQ(accept(at(2, kEdge + 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, -kEdge - 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, 0, kEdge + 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, 0, -kEdge - 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, 0, 0, kEdge + 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, 0, 0, -kEdge - 1)), record::Reject::kRange);
  EXPECT_EQ(accept(at(2, 2'000'000'000)), record::Reject::kRange) << "where the drivers end";
  EXPECT_EQ(accept(at(2, -kEdge, kEdge, -kEdge)), std::nullopt) << "a rejected sample moves no time";
  EXPECT_EQ(desk.memory().counters.rejected, 7U);
  EXPECT_EQ(desk.memory().counters.odometry, 2U);
}

/// Towards the post and back, 2 s each; between them 3 s where the wheels count 30 km.
Script lost_for_a_while() {
  Script script;
  for (int i = 0; i < 350; ++i) {
    const double t = 0.02 * i;
    const bool lost = i >= 100 && i < 250;
    const int step = i < 100 ? i : 350 - i;
    const double x = 0.0008 * step;
    sensor::OdometrySample sample = desk_odometry(t, x);
    if (lost) sample.x = base::Metres{300'000'000};
    script.odometry.push_back({base::Time::nearest(t), sample});
    script.camera.push_back({base::Time::nearest(t), desk_frame(t, static_cast<std::uint32_t>(i), x)});
  }
  return script;
}

TEST(OdometryRange, EveryModeDoesTheSame) {
  Desk<> log(Mode::kLog, lost_for_a_while());
  log.turn(8'000);
  const console::Counters& expected = log.memory().counters;
  EXPECT_EQ(expected.rejected, 150U);
  EXPECT_EQ(expected.odometry, 200U);
  EXPECT_GT(expected.frames, 190U);
  EXPECT_EQ(expected.records_dropped, 0U);
  EXPECT_EQ(log.memory().poses.latest().position.x, 80);  // 0.0008 m in 10 um
  for (const Mode mode : {Mode::kText, Mode::kPlot, Mode::kQuiet}) {
    SCOPED_TRACE(name(mode));
    Desk<> desk(mode, lost_for_a_while());
    desk.turn(8'000);
    EXPECT_EQ(desk.memory().map.digest(), log.memory().map.digest());
    EXPECT_EQ(desk.memory().counters.rejected, expected.rejected);
    EXPECT_EQ(desk.memory().counters.odometry, expected.odometry);
    EXPECT_EQ(desk.memory().counters.frames, expected.frames);
    EXPECT_EQ(desk.memory().counters.refused, expected.refused);
  }
}

TEST(OdometryRange, TheLinkSaysSo) {
  Desk<> log(Mode::kLog, lost_for_a_while());
  log.turn(8'000);
  const std::string records = log.link.take_said();
  const std::size_t lost = records.find(",odometry,unready,out of range*");
  ASSERT_NE(lost, std::string::npos) << records.substr(0, 500);
  EXPECT_NE(records.find(",odometry,ok,", lost), std::string::npos) << "it came back";

  Desk<> text(Mode::kText, lost_for_a_while());
  text.turn(4'500);
  EXPECT_NE(text.link.take_said().find("odometry is unready: its position is more than 1000 m"), std::string::npos);
  EXPECT_NE(text.type_line("status").find("odometry link unready"), std::string::npos);
  text.turn(4'000);
  EXPECT_NE(text.type_line("status").find("odometry link ok"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::test
