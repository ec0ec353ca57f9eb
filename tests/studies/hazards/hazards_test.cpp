// The judges of the table, on runs made by hand: a late stop has to be found late.
#include <gtest/gtest.h>

#include <numbers>

#include "host/geometry/rings.hpp"
#include "tests/studies/hazards/outcome.hpp"
#include "tests/studies/hazards/scenery.hpp"

namespace fencepost::test {
namespace {

using record::AlertLevel;

record::AlertReport alert(double t, AlertLevel level, std::uint32_t id = 1) {
  record::AlertReport report;
  report.t = base::Time::nearest(t);
  report.level = level;
  report.id = id;
  return report;
}

// Straight on at 0.1 m/s towards a box whose front is 1 m ahead: alert.stop at 7.5 s, contact at 9 s.
Encounter head_on() {
  Encounter met;
  met.scene.objects = {thing("box", 1, 0.1, box_at({0, 1.1, 0, 0}, 0.2, 0.4))};
  met.route = Route({}, {{1, 0.1, 0}});
  met.seconds = 20;
  return met;
}

History made(const Encounter& met, double end, std::vector<record::AlertReport> alerts) {
  History history;
  history.end = end;
  for (int i = 0; i * kTruthStep <= end + kTruthStep; ++i) history.progress.push_back(i * kTruthStep);
  history.shown.assign(met.scene.objects.size(), {0.1, 0.2, 0.3, 0.4});
  history.alerts = std::move(alerts);
  return history;
}

Outcome approached(std::vector<record::AlertReport> alerts, double end = 8.95) {
  const Encounter met = head_on();
  Outcome outcome;
  const Judged run(met, made(met, end, std::move(alerts)));
  judge_approached(run, 0, outcome);
  return outcome;
}

TEST(Approached, AStopInTimeAndToTheEndKeepsThePromise) {
  const Outcome outcome = approached({alert(6.5, AlertLevel::kStop)});
  EXPECT_EQ(outcome.asked, 1U);
  EXPECT_EQ(outcome.kept, 1U);
  ASSERT_EQ(outcome.measures.size(), 1U);
  EXPECT_NEAR(outcome.measures[0], 1 - 0.65, 1e-9);
  EXPECT_TRUE(outcome.failures.empty());
}

TEST(Approached, ALateOneDoesNot) {
  const Outcome outcome = approached({alert(7.6, AlertLevel::kStop)});
  EXPECT_EQ(outcome.kept, 0U);
  EXPECT_NEAR(outcome.measures[0], 0.24, 1e-9);
  EXPECT_EQ(outcome.failures.size(), 1U);
}

TEST(Approached, NeitherDoesOneThatEndsBeforeTheContact) {
  EXPECT_EQ(approached({alert(6.5, AlertLevel::kStop), alert(8.8, AlertLevel::kWarn)}).kept, 0U);
  EXPECT_EQ(
      approached({alert(6.5, AlertLevel::kStop), alert(8.0, AlertLevel::kClear), alert(8.1, AlertLevel::kStop, 2)})
          .kept,
      0U);
}

TEST(Approached, NorAWarningNorNothing) {
  EXPECT_EQ(approached({alert(6.5, AlertLevel::kWarn)}).kept, 0U);
  const Outcome nothing = approached({});
  EXPECT_EQ(nothing.asked, 1U);
  EXPECT_EQ(nothing.kept, 0U);
  EXPECT_EQ(nothing.measures[0], 0);
}

TEST(Approached, WhoSaysStopDoesNotMatter) {
  // One object ends, another's stop began before: a stop is in force all the time.
  EXPECT_EQ(approached(
                {alert(6.5, AlertLevel::kStop, 3), alert(7.0, AlertLevel::kStop, 0), alert(7.8, AlertLevel::kClear, 3)})
                .kept,
            1U);
}

TEST(Approached, IsNotAskedOfWhatWasHardlySeenOrIsNotReached) {
  const Encounter met = head_on();
  History history = made(met, 8.95, {});
  history.shown[0] = {0.1, 0.2, 7.6};
  Outcome outcome;
  judge_approached(Judged(met, history), 0, outcome);
  judge_approached(Judged(met, made(met, 7.0, {})), 0, outcome);
  EXPECT_EQ(outcome.asked, 0U);
}

TEST(Approached, WhatStandsInFrontOfItEndsTheRunAndNotTheDuty) {
  Encounter met = head_on();
  met.scene.objects.push_back(thing("grey", 0, 0.04, box_at({0, 0.98, 0, 0}, 0.02, 0.4)));
  // Contact with the grey box at 8.65 s; the other one's clearance is then 0.035 m.
  Outcome outcome;
  judge_approached(Judged(met, made(met, 8.65, {alert(7, AlertLevel::kStop), alert(8, AlertLevel::kClear)})), 0,
                   outcome);
  EXPECT_EQ(outcome.asked, 1U);
  EXPECT_EQ(outcome.kept, 0U);
}

TEST(FalseStops, NeedAReasonWhenTheyBegin) {
  // 1.5 x 0.25 m is reached at 6.25 s; 1.5 x 0.8 s before the margin's contact (8.5 s) is later.
  const Encounter met = head_on();
  Outcome outcome;
  judge_false_stops(Judged(met, made(met, 8.95, {alert(6.3, AlertLevel::kStop)})), outcome);
  EXPECT_EQ(outcome.false_stops, 0U);
  judge_false_stops(Judged(met, made(met, 8.95, {alert(6.2, AlertLevel::kStop), alert(6.3, AlertLevel::kStop, 2)})),
                    outcome);
  EXPECT_EQ(outcome.false_stops, 1U);
  EXPECT_EQ(outcome.grazes, 0U);
  EXPECT_DOUBLE_EQ(outcome.seconds, 2 * 8.95);
}

TEST(FalseStops, WhatPassesAreGrazesOrFalse) {
  for (const auto& [aside, false_stops, grazes] : {std::tuple{0.14, 0U, 0U}, {0.16, 1U, 1U}, {0.20, 1U, 0U}}) {
    Encounter met = head_on();
    met.scene.objects = {thing("post", 1, 0.1, box_at({0, 1, aside + 0.05, 0}, 0.1, 0.1))};
    Outcome outcome;
    judge_false_stops(Judged(met, made(met, 9, {alert(7.5, AlertLevel::kStop)})), outcome);
    EXPECT_EQ(outcome.false_stops, false_stops) << aside;
    EXPECT_EQ(outcome.grazes, grazes) << aside;
  }
}

// A ball of 5 cm at 0.5 m/s from 2 m towards a stationary robot. Contact is when its centre is 0.15 m away (and
// kTouching), at 3.69 s.
Encounter ball_ahead() {
  Encounter met;
  host::SceneObject ball = thing("ball", 1, 0.1, {host::circle_ring({2, 0}, 0.05), {}});
  ball.path = {{0, 2, 0, 0}, {4, 0, 0, 0}};
  met.scene.objects = {ball};
  met.seconds = 5;
  return met;
}

Outcome rolled(std::vector<record::AlertReport> alerts, double before = kBefore) {
  const Encounter met = ball_ahead();
  Outcome outcome;
  judge_contact(Judged(met, made(met, 3.7, std::move(alerts))), 0, outcome, before);
  return outcome;
}

TEST(Contact, AStopIsDueHalfASecondBefore) {
  const Outcome early = rolled({alert(3.1, AlertLevel::kStop)});
  EXPECT_EQ(early.asked, 1U);
  EXPECT_EQ(early.kept, 1U);
  EXPECT_NEAR(early.measures[0], 3.69 - 3.1, 0.011);
  const Outcome late = rolled({alert(3.3, AlertLevel::kStop)});
  EXPECT_EQ(late.kept, 0U);
  EXPECT_NEAR(late.measures[0], 3.69 - 3.3, 0.011);
  EXPECT_EQ(rolled({}).measures[0], 0);
  EXPECT_EQ(rolled({alert(3.1, AlertLevel::kStop)}, 0.58).kept, 1U);
  EXPECT_EQ(rolled({alert(3.1, AlertLevel::kStop)}, 0.6).kept, 0U);
}

TEST(FalseStops, WhatComesByItselfMayBeAnnouncedTwoSecondsAhead) {
  // The ball meets the margin, 0.15 m around the origin, when its centre is 0.2 m away: at 3.6 s.
  for (const auto& [t, false_stops] : {std::pair{1.65, 0U}, {1.5, 1U}}) {
    Outcome outcome;
    const Encounter met = ball_ahead();
    judge_false_stops(Judged(met, made(met, 3.7, {alert(t, AlertLevel::kStop)})), outcome);
    EXPECT_EQ(outcome.false_stops, false_stops) << t;
  }
}

TEST(Silence, CountsEachClearBeforeAnObstacle) {
  const Encounter met = head_on();
  const auto judged = [&](double end, std::vector<record::AlertReport> alerts) {
    Outcome outcome;
    judge_silence(Judged(met, made(met, end, std::move(alerts))), 0, 0.3, outcome);
    return outcome;
  };
  EXPECT_EQ(judged(8, {alert(6, AlertLevel::kStop), alert(7.5, AlertLevel::kWarn)}).kept, 1U);
  // A notice is not enough, and 0.3 m is reached at 7 s: what is clear before does not count.
  const Outcome clears =
      judged(8, {alert(6, AlertLevel::kStop), alert(6.5, AlertLevel::kNotice), alert(6.9, AlertLevel::kStop),
                 alert(7.2, AlertLevel::kNotice), alert(7.5, AlertLevel::kWarn), alert(7.8, AlertLevel::kClear)});
  EXPECT_EQ(clears.kept, 0U);
  EXPECT_EQ(clears.measures[0], 2);
  EXPECT_EQ(judged(8.96, {alert(6, AlertLevel::kStop)}).kept, 0U) << "a contact is one whatever is said";
}

TEST(Removal, NeedsAnAlertBeforeAndNoneAfter) {
  constexpr std::uint8_t kColour = 1;
  const Encounter met = head_on();
  const auto judged = [&](std::vector<record::AlertReport> alerts) {
    Outcome outcome;
    judge_removal(Judged(met, made(met, 8, std::move(alerts))), kColour, 4, 1, 1, outcome);
    return outcome;
  };
  const Outcome good = judged({alert(2, AlertLevel::kWarn), alert(4.9, AlertLevel::kClear)});
  EXPECT_EQ(good.kept, 1U);
  EXPECT_NEAR(good.measures[0], 0.9, 1e-9);
  EXPECT_EQ(judged({alert(2, AlertLevel::kWarn), alert(5.1, AlertLevel::kClear)}).kept, 0U);
  EXPECT_EQ(judged({}).kept, 0U) << "nothing was said that could end";
  record::AlertReport background = alert(6, AlertLevel::kNotice);
  background.distance = base::Metres::nearest(1.1);
  EXPECT_EQ(judged({alert(2, AlertLevel::kWarn), alert(4.9, AlertLevel::kClear), background}).kept, 1U);
  background.distance = base::Metres::nearest(0.9);
  EXPECT_EQ(judged({alert(2, AlertLevel::kWarn), alert(4.9, AlertLevel::kClear), background}).kept, 0U);
  background.signature = kColour + 1;
  EXPECT_EQ(judged({alert(2, AlertLevel::kWarn), alert(4.9, AlertLevel::kClear), background}).kept, 1U);
  const Outcome forever = judged({alert(2, AlertLevel::kNotice)});
  EXPECT_EQ(forever.kept, 0U);
  EXPECT_NEAR(forever.measures[0], 4, 1e-9);
}

TEST(Told, InASecondAndAsLongAsItLasts) {
  const Encounter met = head_on();
  const auto judged = [&](double until, std::vector<record::AlertReport> alerts) {
    Outcome outcome;
    judge_told(Judged(met, made(met, 8, std::move(alerts))), 3, until, 1, outcome);
    return outcome;
  };
  const Outcome good = judged(5, {alert(3.5, AlertLevel::kStop, 0), alert(5.8, AlertLevel::kClear, 0)});
  EXPECT_EQ(good.kept, 1U);
  EXPECT_NEAR(good.measures[0], 0.5, 1e-9);
  EXPECT_EQ(judged(5, {alert(4.1, AlertLevel::kStop, 0), alert(5.8, AlertLevel::kClear, 0)}).kept, 0U) << "late";
  EXPECT_EQ(judged(5, {alert(3.5, AlertLevel::kStop, 0), alert(4.9, AlertLevel::kClear, 0)}).kept, 0U) << "too short";
  EXPECT_EQ(judged(5, {alert(3.5, AlertLevel::kStop, 0), alert(6.2, AlertLevel::kClear, 0)}).kept, 0U) << "too long";
  EXPECT_EQ(judged(5, {alert(3.5, AlertLevel::kWarn, 0)}).kept, 0U) << "a warning lets it drive";
  EXPECT_EQ(judged(100, {alert(3.5, AlertLevel::kStop, 0)}).kept, 1U) << "to the end";
}

TEST(Stretches, TheLastWordAboutEachIdCounts) {
  const std::vector<record::AlertReport> said = {alert(1, AlertLevel::kStop, 1),  alert(2, AlertLevel::kStop, 2),
                                                 alert(3, AlertLevel::kClear, 1), alert(4, AlertLevel::kWarn, 2),
                                                 alert(5, AlertLevel::kStop, 1),  alert(6, AlertLevel::kClear, 1),
                                                 alert(6, AlertLevel::kStop, 3)};
  const Stretches stops(said, AlertLevel::kStop);
  ASSERT_EQ(stops.all().size(), 2U) << "an id that takes over at once leaves no gap";
  EXPECT_TRUE(stops.throughout(1, 3.9));
  EXPECT_FALSE(stops.throughout(1, 4));
  EXPECT_FALSE(stops.at(4.5));
  EXPECT_TRUE(stops.throughout(5, 100));
}

TEST(Body, AnOutlineTurnsWithTheRobot) {
  Encounter met;
  met.body = Body::box(0.1, 0.3, 0.2);
  met.scene.objects = {thing("post", 1, 0.1, box_at({0, 0, 0.35, 0}, 0.1, 0.1))};
  met.route = Route({}, {{1, 0, -std::numbers::pi / 2}});
  const Truth truth(met);
  EXPECT_NEAR(truth.clearance(0, 0, 0), 0.2, 1e-9) << "beside the robot: 0.3 - 0.1";
  EXPECT_NEAR(truth.clearance(0, 1, 1), 0, 1e-9) << "turned to the right the tail is at 0.3 m to the left";
  EXPECT_NEAR(truth.distance(0, 1, 1), 0.3, 1e-9);
}

TEST(Route, GoesAlongItsLegs) {
  // A quarter of a circle of 0.5 m to the left, then straight on.
  const Route route({0, 1, 2, 0}, {{2, 0.5 * std::numbers::pi / 4, std::numbers::pi / 4}, {1, 0.2, 0}});
  const host::TimedPose corner = route.at(2);
  EXPECT_NEAR(corner.x, 1.5, 1e-9);
  EXPECT_NEAR(corner.y, 2.5, 1e-9);
  EXPECT_NEAR(route.at(5).y, 2.5 + 0.6, 1e-9);
  EXPECT_NEAR(route.at(5).heading, std::numbers::pi / 2, 1e-9);
  EXPECT_EQ(route.at(-1).x, 1);
}

}  // namespace
}  // namespace fencepost::test
