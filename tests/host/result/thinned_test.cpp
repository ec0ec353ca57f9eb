#include "host/result/thinned.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::host {
namespace {

using record::AlertLevel;
using record::AlertReport;

/// The pose at `t` of an even drive between the two kept poses around it.
PoseResult at(const std::vector<PoseResult>& path, double t) {
  std::size_t i = 1;
  while (i + 1 < path.size() && path[i].t < t) ++i;
  const PoseResult& a = path[i - 1];
  const PoseResult& b = path[i];
  const double share = (t - a.t) / (b.t - a.t);
  const double turn = std::remainder(b.heading - a.heading, 2 * std::numbers::pi);
  return {t, a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.heading + share * turn};
}

/// Straight on, around, a stop, a turn on the spot, back.
std::vector<PoseResult> drive(std::size_t samples) {
  std::vector<PoseResult> path;
  PoseResult pose;
  for (std::size_t i = 0; i < samples; ++i) {
    path.push_back(pose);
    const std::size_t phase = i / 200 % 5;
    const double speed = phase == 2 || phase == 3 ? 0 : 0.3;
    const double turn = phase == 1 ? 0.4 : phase == 3 ? 1.1 : 0;
    pose.t += 0.05;
    pose.heading = std::remainder(pose.heading + 0.05 * turn, 2 * std::numbers::pi);
    pose.x += 0.05 * speed * std::cos(pose.heading);
    pose.y += 0.05 * speed * std::sin(pose.heading);
  }
  return path;
}

TEST(ThinPath, IsNeverFartherThanToldFromWhereTheRobotWas) {
  const std::vector<PoseResult> path = drive(20'000);
  for (const double tolerance : {0.001, 0.02, 0.3}) {
    const std::vector<PoseResult> kept = thin_path(path, tolerance);
    EXPECT_LT(kept.size(), path.size() / 4);
    EXPECT_EQ(kept.front().t, path.front().t);
    EXPECT_EQ(kept.back().t, path.back().t);
    for (const PoseResult& pose : path) {
      const PoseResult shown = at(kept, pose.t);
      ASSERT_LE(std::hypot(shown.x - pose.x, shown.y - pose.y), tolerance + 1e-9) << pose.t;
      ASSERT_LE(std::abs(std::remainder(shown.heading - pose.heading, 2 * std::numbers::pi)), 0.02 + 1e-9) << pose.t;
    }
  }
}

TEST(ThinPath, AStraightDriveHasTwoEndsAndAShortOneIsAsItWas) {
  std::vector<PoseResult> path;
  for (int i = 0; i < 1'000; ++i) path.push_back({i * 0.05, i * 0.01, 0, 0});
  EXPECT_EQ(thin_path(path, 0.001).size(), 2U);
  EXPECT_TRUE(thin_path({}, 0.1).empty());
  EXPECT_TRUE(thin_path_to({}, 10).empty());
  EXPECT_EQ(thin_path_to({{0, 0, 0, 0}, {1, 1, 0, 2}}, 2).size(), 2U);
}

TEST(ThinPath, HasNoMoreThanAsked) {
  const std::vector<PoseResult> path = drive(50'000);
  for (const std::size_t most : {2U, 17U, 300U, 4'000U}) {
    const std::vector<PoseResult> kept = thin_path_to(path, most);
    EXPECT_LE(kept.size(), most);
    EXPECT_EQ(kept.front().t, path.front().t);
    EXPECT_EQ(kept.back().t, path.back().t);
  }
  std::vector<PoseResult> spins;
  for (int i = 0; i < 10'000; ++i) spins.push_back({i * 0.05, 0, 0, std::remainder(i * 1.0, 2 * std::numbers::pi)});
  EXPECT_LE(thin_path_to(spins, 100).size(), 100U);
}

AlertReport alert(double t, AlertLevel level, std::uint32_t id, double distance) {
  AlertReport report;
  report.t = base::Time::nearest(t);
  report.level = level;
  report.id = id;
  report.distance = base::Metres::nearest(distance);
  return report;
}

EachAlert each_of(const std::vector<AlertReport>& alerts) {
  return [&alerts](const auto& visit) {
    for (const AlertReport& one : alerts) visit(one);
  };
}

TEST(ThinAlerts, FewAreAllKept) {
  const std::vector<AlertReport> alerts(16, alert(1, AlertLevel::kStop, 1, 0.2));
  const ThinnedAlerts kept = thin_alerts(each_of(alerts), 16);
  EXPECT_EQ(kept.kept.size(), 16U);
  EXPECT_EQ(kept.all, 16U);
  EXPECT_EQ(kept.stops, 16U);
  EXPECT_EQ(thin_alerts(each_of({}), 16).all, 0U);
}

TEST(ThinAlerts, OfManyTheWorstTheLastAndTheNearestAreKept) {
  std::vector<AlertReport> alerts;
  for (int i = 0; i < 100'000; ++i) {
    const std::uint32_t id = i % 3 == 0 ? 1 : 2;
    alerts.push_back(alert(i * 0.02, i % 2 == 0 ? AlertLevel::kNotice : AlertLevel::kClear, id, 1));
  }
  alerts[50'000].level = AlertLevel::kStop;  // at 1000 s
  alerts[70'001].distance = base::Metres::nearest(0.125);
  alerts.back().level = AlertLevel::kWarn;
  const ThinnedAlerts kept = thin_alerts(each_of(alerts), 2'000);
  EXPECT_EQ(kept.all, alerts.size());
  EXPECT_EQ(kept.stops, 1U);
  EXPECT_LE(kept.kept.size(), 2'000U);
  EXPECT_GT(kept.kept.size(), 500U);
  EXPECT_TRUE(std::ranges::is_sorted(kept.kept, {}, [](const AlertReport& one) { return one.t.raw; }));
  const auto has = [&](const AlertReport& wanted) { return std::ranges::find(kept.kept, wanted) != kept.kept.end(); };
  EXPECT_TRUE(has(alerts[50'000]));
  EXPECT_TRUE(has(alerts[70'001]));
  EXPECT_TRUE(has(alerts.back()));
  for (std::size_t i = 1; i < 50; ++i) {  // every part of the run is in it
    EXPECT_TRUE(std::ranges::any_of(kept.kept, [&](const AlertReport& one) {
      return std::abs(one.t.to_double() - 40.0 * static_cast<double>(i)) < 40;
    })) << i;
  }
}

TEST(ThinAlerts, AreBoundedWhateverTheObjectsAndTimes) {
  std::vector<AlertReport> alerts;
  for (std::uint32_t i = 0; i < 20'000; ++i) alerts.push_back(alert(i * 0.1, AlertLevel::kWarn, i, 0.5));
  EXPECT_LE(thin_alerts(each_of(alerts), 64).kept.size(), 64U);
  EXPECT_GE(thin_alerts(each_of(alerts), 64).kept.size(), 16U);
  for (AlertReport& one : alerts) one.t = base::Time{};
  EXPECT_LE(thin_alerts(each_of(alerts), 64).kept.size(), 64U);
  for (std::uint32_t i = 0; i < 20'000; ++i) alerts[i].t = base::Time::nearest(i % 100 * 1.0);
  EXPECT_LE(thin_alerts(each_of(alerts), 16).kept.size(), 16U);
}

}  // namespace
}  // namespace fencepost::host
