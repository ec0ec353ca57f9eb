// The loop reports a cable's state once, in the words of its mode.
#include "firmware/loop/link_watch.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using base::milliseconds;
using base::Time;
using console::Mode;
using sensor::LinkState;

class LinkWatchTest : public ::testing::Test {
 protected:
  /// Whether the state is due to be reported; then it counts as sent.
  bool tells(LinkState state, std::int64_t ms) {
    const auto due = watch.observe(state, Time{} + milliseconds(ms));
    if (due) watch.sent();
    return due.has_value();
  }
  loop::LinkWatch watch;
};

TEST_F(LinkWatchTest, TellsGoneAndBackAtOnceAndOnce) {
  EXPECT_TRUE(tells(LinkState::kOk, 5));
  EXPECT_FALSE(tells(LinkState::kOk, 6));
  EXPECT_TRUE(tells(LinkState::kAbsent, 10));
  EXPECT_FALSE(tells(LinkState::kAbsent, 20));
  EXPECT_FALSE(tells(LinkState::kAbsent, 100'000));
  EXPECT_TRUE(tells(LinkState::kOk, 100'001));
}

TEST_F(LinkWatchTest, WhatPassesIsNotTold) {
  EXPECT_FALSE(tells(LinkState::kSilent, 0)) << "a device that starts";
  EXPECT_FALSE(tells(LinkState::kUnready, 900));
  EXPECT_TRUE(tells(LinkState::kOk, 1'000));
  EXPECT_FALSE(tells(LinkState::kEmpty, 1'100)) << "a blob that flickers";
  EXPECT_FALSE(tells(LinkState::kOk, 2'050));
  EXPECT_FALSE(tells(LinkState::kEmpty, 2'100));
  EXPECT_FALSE(tells(LinkState::kEmpty, 3'099));
  EXPECT_TRUE(tells(LinkState::kEmpty, 3'200));
}

TEST_F(LinkWatchTest, LastsASecondAtAnyTimeOfTheClock) {
  for (std::int64_t start = 0; start < 60'000; start += 370) {
    watch = {};
    EXPECT_FALSE(tells(LinkState::kSilent, start));
    EXPECT_FALSE(tells(LinkState::kSilent, start + 999)) << start;
    EXPECT_TRUE(tells(LinkState::kSilent, start + 1'100)) << start;
  }
}

TEST_F(LinkWatchTest, WaitsUntilItCouldBeTold) {
  EXPECT_TRUE(watch.observe(LinkState::kOk, Time{}).has_value());
  EXPECT_TRUE(watch.observe(LinkState::kOk, Time{}).has_value());
  watch.sent();
  EXPECT_FALSE(watch.observe(LinkState::kOk, Time{}).has_value());
  EXPECT_EQ(watch.last_sent(), LinkState::kOk);
  watch.resend();
  EXPECT_EQ(watch.last_sent(), std::nullopt);
  EXPECT_TRUE(watch.observe(LinkState::kOk, Time{}).has_value());
}

// Seconds at which the links become so; nothing is seen and nobody moves.
Script links(const std::vector<std::pair<double, LinkState>>& camera) {
  Script script;
  for (const auto& [t, state] : camera) script.camera.push_back({Time::nearest(t), base::Error::kNotReady, state, 0});
  script.odometry.push_back({Time{}, base::Error::kNotReady, LinkState::kOk, 0});
  return script;
}

TEST(LinkMeaningful, SaysOneSentenceAChangeInModeText) {
  Desk<> desk(Mode::kText, links({{0.0, LinkState::kOk}, {0.1, LinkState::kSilent}, {3.0, LinkState::kOk}}));
  desk.turn(4'000);
  EXPECT_EQ(desk.link.said(),
            "camera works\r\n"
            "odometry works\r\n"
            "camera is silent: nothing answers; check its power, the wires (TX to RX) and the baud\r\n"
            "camera works\r\n");
}

TEST(LinkMeaningful, WritesRecordsInModeLogBehindTheHeader) {
  Desk<> desk(Mode::kLog, links({{0.0, LinkState::kOk}, {0.5, LinkState::kAbsent}}));
  desk.turn(1'000);
  const std::string& said = desk.link.said();
  const std::size_t header = said.find("$FPHDR");
  const std::size_t works = said.find("$FPLNK,0.0000,camera,ok,*");
  EXPECT_LT(header, works);
  EXPECT_NE(works, std::string::npos) << said;
  EXPECT_NE(said.find("$FPLNK,0.0000,odometry,ok,*"), std::string::npos) << said;
  EXPECT_NE(said.find("$FPLNK,0.5000,camera,absent,not there*"), std::string::npos) << said;
  EXPECT_EQ(said.find("camera works"), std::string::npos);
}

// A recording that begins now knows how the links are.
TEST(LinkMeaningful, TellsThemAgainToANewLog) {
  Desk<> desk(Mode::kQuiet, links({{0.0, LinkState::kOk}}));
  desk.turn(100);
  EXPECT_EQ(desk.link.take_said(), "");
  desk.type_line("mode log");
  desk.turn(100);
  const std::string said = desk.type_line("reset");
  EXPECT_NE(said.find(",camera,ok,*"), std::string::npos) << said;
  EXPECT_NE(said.find(",odometry,ok,*"), std::string::npos) << said;
}

// It is said once, so it is not dropped where the line is slow.
TEST(LinkMeaningful, WaitsForRoom) {
  Desk<> desk(Mode::kText, links({{0.0, LinkState::kOk}}));
  desk.link.bytes_a_turn = 0;
  while (desk.memory().output.put_line([](std::span<char> room) -> std::size_t { return room.size() < 80 ? 0 : 80; })) {
  }
  desk.turn(50);
  EXPECT_EQ(desk.memory().counters.records_dropped, 0U);
  desk.link.bytes_a_turn = 200;
  desk.turn(50);
  EXPECT_NE(desk.link.said().find("camera works\r\n"), std::string::npos);
}

TEST(LinkMeaningful, SaysNothingDuringTheSelfTest) {
  Desk<> desk(Mode::kText, links({{0.0, LinkState::kOk}, {0.2, LinkState::kAbsent}}));
  desk.turn(190);
  desk.link.take_said();
  desk.link.type("selftest\r");
  while (!desk.pipeline().testing()) desk.turn();
  while (desk.pipeline().testing()) desk.turn();
  EXPECT_EQ(desk.link.take_said().find("camera"), std::string::npos);
  desk.turn(50);
  EXPECT_EQ(desk.link.said(), "camera is absent; going on without it until it is back\r\n");
}

/// A sensor that knows itself by name; another that has no cable.
struct Named {
  std::string device = "pixy2";
  static LinkState link() { return LinkState::kUnready; }
  [[nodiscard]] console::LinkWords link_words(LinkState /*state*/) const {
    return {"the Pixy2", device, "on I2C", "let go of its button"};
  }
};

TEST(LinkMeaningful, UsesTheWordsOfASensorThatHasThem) {
  Desk<> desk;
  loop::LinkWatch watch;
  desk.pipeline().reporter().link(watch, Named{}, "camera", Time{});
  desk.pipeline().reporter().link(watch, Named{}, "camera", Time{} + milliseconds(1'100));
  desk.turn();
  EXPECT_NE(desk.link.said().find("the Pixy2 is unready: let go of its button\r\n"), std::string::npos);
}

TEST(LinkMeaningful, SaysNothingOfASensorWithoutACable) {
  Desk<> desk;
  loop::LinkWatch watch;
  for (const int ms : {0, 1'100}) {
    desk.pipeline().reporter().link(watch, Named{""}, "camera", Time{} + milliseconds(ms));
  }
  EXPECT_TRUE(desk.memory().output.waiting().empty());
}

}  // namespace
}  // namespace fencepost::test
