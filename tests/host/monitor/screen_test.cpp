// The screen of any size says the level and never more than fits; what it shows is what the records say.
#include "host/monitor/screen.hpp"

#include <gtest/gtest.h>

#include <string>

#include "host/monitor/log_player.hpp"

namespace fencepost::host::monitor {
namespace {

record::ObjectReport object_at(std::uint32_t id, double x, double y, double radius) {
  record::ObjectReport report;
  report.t = base::Time::nearest(1);
  report.id = id;
  report.signature = 1;
  report.x = base::Metres::nearest(x);
  report.y = base::Metres::nearest(y);
  report.radius = base::Metres::nearest(radius);
  report.state = record::ObjectState::kConfirmed;
  return report;
}

record::AlertReport alert_of(std::uint32_t id, record::AlertLevel level) {
  record::AlertReport alert;
  alert.t = base::Time::nearest(1);
  alert.level = level;
  alert.id = id;
  alert.signature = 1;
  alert.distance = base::Metres::nearest(0.24);
  return alert;
}

Believed driven() {
  Believed believed;
  believed.accept(record::Signature{1, {0xD0, 0x20, 0x20}, "red"});
  for (int i = 0; i <= 100; ++i) {
    believed.accept(sensor::OdometrySample{base::Time::nearest(0.01 * i), base::Metres::nearest(0.01 * i), {}, {}});
  }
  believed.accept(object_at(1, 1.3, 0, 0.06));
  believed.accept(object_at(27, 0.5, 0.5, 0.04));
  return believed;
}

std::string text_of(const Cells& cells) {
  std::string text;
  for (std::size_t row = 0; row < cells.size().rows; ++row) text += cells.row(row, false) + "\n";
  return text;
}

TEST(MonitorScreen, FitsEverySize) {
  Believed believed = driven();
  believed.accept(alert_of(1, record::AlertLevel::kStop));
  for (std::size_t columns = 1; columns <= 100; columns += 3) {
    for (std::size_t rows = 1; rows <= 40; ++rows) {
      const Cells cells = screen_of(believed, {"/dev/ttyACM0", "x1", "q quit"}, {columns, rows});
      for (std::size_t row = 0; row < rows; ++row) ASSERT_LE(length(cells.row(row, false)), columns);
      ASSERT_EQ(cells.row(0, false).find("STOP") != std::string::npos, columns >= 6) << columns << "x" << rows;
    }
  }
}

TEST(MonitorScreen, ShowsRobotTrailObjectsAndLinks) {
  Believed believed = driven();
  believed.accept(record::LinkReport{base::Time::nearest(1), "gyro", sensor::LinkState::kSilent, ""});
  const std::string text = text_of(screen_of(believed, {"run.log", "x1", "q quit"}, {80, 24}));
  EXPECT_NE(text.find("A 1 red"), std::string::npos) << text;
  EXPECT_NE(text.find("A 27 red"), std::string::npos) << "ids tell letters apart\n" << text;
  EXPECT_NE(text.find(" 0.24 m   0 l"), std::string::npos) << "from the robot's origin to its near side\n" << text;
  EXPECT_NE(text.find("gyro silent"), std::string::npos) << text;
  EXPECT_NE(text.find('^'), std::string::npos) << text;
  EXPECT_NE(text.find("q quit"), std::string::npos) << text;
  // The trail runs straight up to the robot.
  std::size_t dots = 0;
  for (const char c : text) dots += c == '.' ? 1U : 0U;
  EXPECT_GT(dots, 8U) << text;
}

TEST(MonitorScreen, NamesAreNotCutWhereTheyHaveRoom) {
  Believed believed;
  believed.accept(record::Signature{1, {}, "landmark 11"});
  believed.accept(object_at(3, 1, 0, 0.05));
  const std::string text = text_of(screen_of(believed, {"run.log", "", ""}, {40, 24}));
  EXPECT_NE(text.find("C 3 landmark 11"), std::string::npos) << text;
}

TEST(MonitorScreen, ManyObjectsAreCountedNotDropped) {
  Believed believed;
  for (std::uint32_t id = 1; id <= 40; ++id) believed.accept(object_at(id, 0.1 * id, 0, 0.03));
  const std::string text = text_of(screen_of(believed, {"run.log", "", ""}, {80, 24}));
  // 18 rows: 17 objects and the others.
  EXPECT_NE(text.find("and 23 more"), std::string::npos) << text;
}

TEST(MonitorScreen, ColoursOnlyWhereAskedAndNoneIsLeftInForce) {
  Believed believed = driven();
  believed.accept(alert_of(1, record::AlertLevel::kStop));
  const Cells cells = screen_of(believed, {"run.log", "", ""}, {80, 24});
  EXPECT_EQ(cells.row(0, false).find('\x1b'), std::string::npos);
  const std::string coloured = cells.row(0, true);
  EXPECT_NE(coloured.find("\x1b[0;1;37;41m STOP"), std::string::npos) << coloured;
  EXPECT_TRUE(coloured.ends_with("\x1b[0m")) << coloured;
}

TEST(Believed, AnAlertEndsWithItsClear) {
  Believed believed = driven();
  believed.accept(alert_of(1, record::AlertLevel::kStop));
  EXPECT_EQ(believed.level(), record::AlertLevel::kStop);
  believed.accept(alert_of(1, record::AlertLevel::kClear));
  EXPECT_EQ(believed.level(), record::AlertLevel::kClear);
}

TEST(Believed, TheHeartbeatsLevelCountsToo) {
  Believed believed;
  believed.accept(record::Heartbeat{base::Time::nearest(1), record::AlertLevel::kBlind, {}, {}});
  EXPECT_EQ(believed.level(), record::AlertLevel::kBlind);
}

TEST(Believed, OdometryGoesOnFromACorrectedPose) {
  Believed believed;
  believed.accept(sensor::OdometrySample{base::Time::nearest(1), base::Metres::nearest(1), {}, {}});
  // A quarter turn to the left, and half a metre to the left of where it thought.
  record::Position corrected;
  corrected.t = base::Time::nearest(1);
  corrected.x = base::Metres::nearest(1);
  corrected.y = base::Metres::nearest(0.5);
  corrected.heading = base::Radians::nearest(1.5708);
  believed.accept(corrected);
  believed.accept(sensor::OdometrySample{base::Time::nearest(2), base::Metres::nearest(2), {}, {}});
  EXPECT_NEAR(believed.pose()->x, 1, 1e-4);
  EXPECT_NEAR(believed.pose()->y, 1.5, 1e-4);
}

TEST(Believed, ANewRunForgetsAllButWhatWasSaid) {
  Believed believed = driven();
  believed.accept(alert_of(1, record::AlertLevel::kStop));
  const std::size_t said = believed.said().size();
  believed.accept(record::Header{});
  EXPECT_TRUE(believed.objects().empty());
  EXPECT_TRUE(believed.trail().empty());
  EXPECT_EQ(believed.level(), record::AlertLevel::kClear);
  EXPECT_EQ(believed.said().size(), said + 1);
}

TEST(Believed, WhatARobotSaysCannotMoveTheCursor) {
  Believed believed;
  believed.hear("\x1b[2Jgone");
  EXPECT_EQ(believed.said().back().text, "?[2Jgone");
}

TEST(Believed, DevicesWithoutEndAreNotAllKept) {
  Believed believed;
  for (int i = 0; i < 10'000; ++i) {
    record::LinkReport link{};
    link.device = sensor::Text("d" + std::to_string(i));
    believed.accept(link);
  }
  EXPECT_EQ(believed.links().size(), 16U);
  EXPECT_TRUE(believed.links().contains("d0"));
  EXPECT_LT(believed.said().size(), 1'000U);
}

TEST(LogPlayer, LinesComeAtTheirTimesOverAllRuns) {
  LogPlayer player("$FPHDR,a\n$FPODO,0.5000,x\n$FPCFG,k,v\n$FPODO,2.0000,x\n$FPHDR,b\n$FPODO,1.0000,y\n");
  const auto until = [&](double t) {
    std::size_t lines = 0;
    while (player.next(t)) ++lines;
    return lines;
  };
  EXPECT_EQ(until(0), 1U);
  EXPECT_EQ(until(1), 2U);
  EXPECT_EQ(until(2), 2U) << "the next run begins at once";
  EXPECT_EQ(until(2.9), 0U);
  EXPECT_EQ(until(3), 1U);
  EXPECT_TRUE(player.ended());
  player.rewind();
  EXPECT_EQ(until(3), 6U);
}

}  // namespace
}  // namespace fencepost::host::monitor
