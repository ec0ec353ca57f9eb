// A car's readings over the console: what is missing is said, what is used is logged as poses; and what `next` answers.
#include <gtest/gtest.h>

#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

using console::Mode;

std::string reading(double t, std::int32_t count, std::optional<std::int32_t> rate,
                    std::optional<std::int32_t> angle = {}) {
  sensor::CarSample sample{base::Time::nearest(t), count, {}, {}};
  if (rate) sample.yaw_rate = base::RadiansPerSecond{*rate};
  if (angle) sample.steering = base::Radians{*angle};
  return line_of(sample);
}

TEST(CarOnTheConsole, SaysWhatIsMissing) {
  Desk<> desk;
  EXPECT_NE(desk.type(reading(1, 0, 0)).find("$FPCAR rejected (range): car.counts is not set: drive a metre"),
            std::string::npos);
  desk.type("set car.counts 2000\n");
  EXPECT_NE(desk.type(reading(1, 0, {})).find("an encoder alone knows no heading"), std::string::npos);
  EXPECT_NE(desk.type(reading(1, 0, {}, 100)).find("set car.wheelbase"), std::string::npos);
  EXPECT_EQ(desk.memory().counters.rejected, 3U);
  EXPECT_EQ(desk.memory().counters.odometry, 0U);
  desk.type("set car.wheelbase 0.17\n");
  EXPECT_EQ(desk.type(reading(1, 0, {}, 100)), "");
  EXPECT_NE(desk.type(reading(1, 10, {}, 100)).find("(time)"), std::string::npos);
  EXPECT_EQ(desk.memory().counters.odometry, 1U);
}

TEST(CarOnTheConsole, IsLoggedAsPoses) {
  Desk<> desk(Mode::kLog);
  desk.type("set car.counts 2000\n");
  desk.type(reading(1, 500, 0));
  const std::string said = desk.type(reading(1.02, 520, 0));
  EXPECT_NE(said.find(line_of(sensor::OdometrySample{base::Time::nearest(1.02), {100}, {}, {}})), std::string::npos)
      << said;
  EXPECT_EQ(said.find("$FPCAR"), std::string::npos);
}

TEST(CarOnTheConsole, ANewRunBeginsAtTheOrigin) {
  Desk<> desk(Mode::kQuiet);
  desk.type("set car.counts 2000\n");
  desk.type(reading(1, 500, 0) + reading(1.02, 520, 0));
  EXPECT_EQ(desk.memory().poses.latest().position.x, 1'000);
  desk.type("reset\n");
  desk.type(reading(2, 900, 0));
  EXPECT_EQ(desk.memory().poses.latest().position.x, 0);
}

TEST(NextCommand, AnswersForEachObjectOrOne) {
  Desk<> desk(Mode::kQuiet, desk_approach(60));
  EXPECT_NE(Desk<>().type("next\n").find("no objects"), std::string::npos);
  desk.turn(1'300);
  desk.link.take_said();
  const std::string all = desk.type("next\n");
  EXPECT_NE(all.find(" deg wide, as from x "), std::string::npos) << all;
  EXPECT_EQ(desk.type("next 1\n"), all) << "there is one";
  EXPECT_NE(desk.type("next 77\n").find("error: '77' is no object"), std::string::npos);
  EXPECT_NE(desk.type("next red\n").find("error: 'red' is no object"), std::string::npos);
}

template <class Report>
struct Sink {
  Report report;
  void accept(const Report& said) { report = said; }
  template <class Record>
  void accept(const Record& /*record*/) {}
};

// The record that answers a command after a drive towards something. It needs odometry first, and room.
template <class Report>
Report answer_to(const std::string& command, const std::string& name) {
  const std::string typed = command + "\n";
  EXPECT_NE(Desk<config::Small>().type(typed).find("no " + command + ": "), std::string::npos);
  Desk<> micro(Mode::kQuiet, desk_approach(60));
  micro.turn(1'300);
  micro.link.take_said();
  EXPECT_NE(micro.type(typed).find(command + ": this board has no room"), std::string::npos);

  Desk<config::Small> desk(Mode::kQuiet, desk_approach(60));
  desk.turn(1'300);
  desk.link.take_said();
  const std::string said = desk.type(typed);
  Sink<Report> sink;
  EXPECT_EQ(said.rfind(name, 0), 0U) << said;
  EXPECT_TRUE(said.ends_with("\r\n") &&
              record::decode(std::string_view(said).substr(0, said.size() - 2), {}, sink).ok())
      << said;
  return sink.report;
}

TEST(SectorsCommand, AnswersWithARecord) {
  const auto report = answer_to<record::SectorReport>("sectors", "$FPSEC,");
  ASSERT_EQ(report.sectors.size(), alert::kSectors);
  EXPECT_TRUE(report.sectors[0].distance) << "it drives ahead and looks there";
  EXPECT_FALSE(report.sectors[18].distance) << "and has never looked behind";
}

TEST(WaysCommand, AnswersWithARecord) {
  const auto report = answer_to<record::WayReport>("ways", "$FPWAY,");
  ASSERT_EQ(report.ways.size(), alert::FreeWays::kWays);
  EXPECT_EQ(report.ways[4].end, record::WayEnd::kThing) << "it drives towards one";
  EXPECT_EQ(report.ways[8].end, record::WayEnd::kUnknown) << "and has never looked behind";
}

}  // namespace
}  // namespace fencepost::test
