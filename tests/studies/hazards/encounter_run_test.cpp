// The closed loop: a robot that hears stop stands. And the listeners' answers to frames.
#include "tests/studies/hazards/encounter_run.hpp"

#include <gtest/gtest.h>

#include "tests/studies/hazards/peer_rules.hpp"
#include "tests/studies/hazards/scenery.hpp"
#include "tests/studies/hazards/table.hpp"

namespace fencepost::test {
namespace {

const Conditions kQuiet{noise_levels({"0"}).front()};

/// Says its lines when their time has come; keeps what it hears.
class Script final : public Listener {
 public:
  explicit Script(std::vector<record::AlertReport> lines) : lines_(std::move(lines)) {}
  void hear(std::string_view line) override {
    heard += line;
    if (!line.starts_with("$FPODO,")) return;
    for (; next_ < lines_.size() && lines_[next_].t.to_double() <= now_ + 1e-9; ++next_) say(lines_[next_]);
    now_ += 0.02;
  }
  [[nodiscard]] double speed_limit() const override { return limit; }
  std::string heard;
  double limit = 1;  ///< m/s

 private:
  std::vector<record::AlertReport> lines_;
  std::size_t next_ = 0;
  double now_ = 0;
};

record::AlertReport at(double t, record::AlertLevel level) {
  record::AlertReport alert;
  alert.t = base::Time::nearest(t);
  alert.level = level;
  return alert;
}

Encounter towards_a_box() {
  Encounter met;
  met.scene = bare_scene(1, kQuiet);
  met.scene.objects = {thing("box", 1, 0.1, box_at({0, 1.1, 0, 0}, 0.2, 0.4))};
  met.route = Route({}, {{1, 0.2, 0}});
  met.seconds = 10;
  return met;
}

TEST(EncounterRun, ARobotThatObeysStandsAndGoesOn) {
  Encounter met = towards_a_box();
  met.obeys = true;
  Script script({at(1, record::AlertLevel::kStop), at(3, record::AlertLevel::kWarn)});
  const History history = run_encounter(met, script);
  const auto progress = [&](double t) { return history.progress[static_cast<std::size_t>(t / kTruthStep + 0.5)]; };
  // Stop comes at 1 s. It brakes from 1.1 s and stands at 1.3 s, after half the way of that time.
  EXPECT_NEAR(progress(1), 1, 1e-9);
  EXPECT_NEAR(progress(2), 1 + met.brake.reaction + met.brake.full / 2, 0.03);
  EXPECT_NEAR(progress(3), progress(2), 1e-9);
  EXPECT_NEAR(progress(4), progress(2) + 1 - met.brake.reaction - met.brake.full / 2, 0.03);
  // The box is 0.9 m away from the body: 4.5 s of driving, and the time that it stood.
  EXPECT_NEAR(history.end, 4.5 + 2, 0.05);
}

TEST(EncounterRun, ARobotThatSlowsIsNoFasterThanTheLimit) {
  Encounter met = towards_a_box();
  met.obeys = true;
  met.slows = true;
  Script script({at(20, record::AlertLevel::kStop)});
  script.limit = 0.15;
  // 0.9 m at 0.15 m/s, but for the first moments.
  EXPECT_NEAR(run_encounter(met, script).end, 6.0, 0.1);
  Script fast({at(20, record::AlertLevel::kStop)});
  EXPECT_NEAR(run_encounter(met, fast).end, 4.5, 0.05) << "and no faster than it means to be";
}

TEST(EncounterRun, OneThatDoesNotDrivesIntoIt) {
  const Encounter met = towards_a_box();
  Script script({at(1, record::AlertLevel::kStop)});
  const History history = run_encounter(met, script);
  EXPECT_NEAR(history.end, 4.5, 0.05);
  EXPECT_GT(frames_before(history, 0, 4), 90U) << "25 frames/s";
}

TEST(EncounterRun, TheRobotHearsTheCalibrationThatItIsTold) {
  Encounter met = towards_a_box();
  Script plain({});
  run_encounter(met, plain);
  met.configured = met.scene.camera;
  met.configured->fx = base::Pixels2::nearest(300);
  Script misled({});
  run_encounter(met, misled);
  EXPECT_NE(misled.heard.find(",300.00,"), std::string::npos);
  EXPECT_EQ(plain.heard.find(",300.00,"), std::string::npos);
  const auto frames = [](const std::string& log) { return log.substr(log.find("$FPFRM,")); };
  EXPECT_EQ(frames(misled.heard).substr(0, 2000), frames(plain.heard).substr(0, 2000)) << "what the lens shows stays";
}

TEST(EncounterRun, FencepostListensAndAPlantedLateStopIsFoundLate) {
  // It says stop before the box, which is in the middle of the image all the time.
  const Encounter met = towards_a_box();
  const Judged run = run_cell(met, kQuiet);
  Outcome outcome;
  judge_approached(run, 0, outcome);
  EXPECT_EQ(outcome.asked, 1U);
  EXPECT_EQ(outcome.kept, 1U);
  EXPECT_EQ(run.history.objects.size(), 1U);
  Conditions late = kQuiet;
  late.settings = {{"alert.stop", "0.12"}, {"alert.ttc_stop", "0.0"}};
  const Judged planted = run_cell(met, late);
  judge_approached(planted, 0, outcome);
  EXPECT_EQ(outcome.asked, 2U);
  EXPECT_EQ(outcome.kept, 1U) << "a planted late stop is found late";
  EXPECT_GT(outcome.measures[0], 0.25);
  EXPECT_LT(outcome.measures[1], 0.25);
}

TEST(EncounterRun, AnOutageIsWhatTheRobotHears) {
  const auto heard = [](Fault fault) {
    Encounter met = towards_a_box();
    met.seconds = 3;
    met.outage = {fault, 1, 2};
    Script script({});
    run_encounter(met, script);
    return script.heard;
  };
  const auto count = [](const std::string& log, std::string_view words) {
    int found = 0;
    for (std::size_t at = log.find(words); at != std::string::npos; at = log.find(words, at + 1)) ++found;
    return found;
  };
  const std::string well = heard(Fault::kNone);
  EXPECT_EQ(count(well, "$FPFRM,") - count(heard(Fault::kCameraSilent), "$FPFRM,"), 25);
  EXPECT_EQ(count(well, "$FPODO,") - count(heard(Fault::kOdometrySilent), "$FPODO,"), 50);
  const std::string frozen = heard(Fault::kCameraFrozen);
  EXPECT_EQ(count(frozen, "$FPFRM,"), count(well, "$FPFRM,"));
  EXPECT_NE(frozen, well);
  const auto boxes = [](const std::string& log, std::string_view frame) {
    const std::size_t at = log.find("$FPFRM," + std::string(frame));
    const std::size_t comma = log.find(',', log.find(',', at + 7) + 1);
    return log.substr(comma, log.find('*', at) - comma);
  };
  EXPECT_EQ(boxes(frozen, "1.0"), boxes(frozen, "1.9"));
  EXPECT_NE(boxes(well, "1.0"), boxes(well, "1.9"));
  EXPECT_NE(heard(Fault::kCameraNonsense), well);
}

TEST(Peers, AreRightAboutTheBlockThatTheyWereSetWith) {
  const sensor::CameraIntrinsics camera = bare_scene(1, kQuiet).camera;
  // 10 cm at 0.25 m: 0.1 * 223.39 / 0.25 = 89.4 pixels.
  sensor::Blob block;
  block.x1 = block.y1 = 0;
  block.x2 = block.y2 = 89;
  EXPECT_TRUE(stops_by_range(camera, block));
  EXPECT_TRUE(stops_by_width(camera, block));
  block.x2 = block.y2 = 88;
  EXPECT_FALSE(stops_by_range(camera, block));
  EXPECT_FALSE(stops_by_width(camera, block));
}

TEST(Table, SaysWhatIsMissed) {
  Outcome sum;
  sum.asked = 200;
  sum.kept = 198;
  sum.seconds = 1200;
  sum.false_stops = 5;
  sum.grazes = 2;
  EXPECT_EQ(missed({99, 1.5}, sum), "");
  EXPECT_NE(missed({99.5, 1.5}, sum).find("99.0 % of 200"), std::string::npos);
  EXPECT_NE(missed({99, 1}, sum).find("1.50 false"), std::string::npos);
  EXPECT_NE(missed({99, {}}, Outcome{}), "") << "nothing asked is nothing kept";
  EXPECT_NE(missed({{}, 1}, Outcome{}), "");
  const Cell cell{"a scene", {99.5, {}}, {}};
  EXPECT_NE(row(cell, Rule::kFencepost, 7, sum, 1).find("**missed**"), std::string::npos);
  EXPECT_EQ(row(cell, Rule::kRange, 7, sum, 1).find("**missed**"), std::string::npos) << "peers are not judged";
}

TEST(Table, MedianAndSeeds) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2);
  EXPECT_FALSE(median({}));
  EXPECT_EQ(use_of({1000, 1}), "tuning");
  EXPECT_EQ(use_of({100, 950}), "neither tuning nor judging");
  EXPECT_EQ(use_of({400, 100'001}), "judging");
}

}  // namespace
}  // namespace fencepost::test
