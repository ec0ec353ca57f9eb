#include "host/emulate/scene/travel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "drivers/odometry/differential_drive.hpp"
#include "host/emulate/models/wheel_adapters.hpp"

namespace fencepost::emulate {
namespace {

using sensor::OdometrySample;

OdometrySample pose(double t, double x, double y, double heading) {
  return {base::Time::nearest(t), base::Metres::nearest(x), base::Metres::nearest(y), base::Radians::nearest(heading)};
}

TEST(TravelLog, DrivesStraightAndBack) {
  const std::vector<OdometrySample> poses = {pose(1, 2, 3, 0), pose(2, 3, 3, 0), pose(3, 2.5, 3, 0)};
  const TravelLog log(poses);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(0.5)).distance, 0);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(1.25)).distance, 0.25);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(1.25)).speed, 1);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(2.5)).speed, -0.5);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(9)).distance, 0.5);
  EXPECT_DOUBLE_EQ(log.at(base::Time::nearest(9)).speed, 0);
  EXPECT_DOUBLE_EQ(log.sideways(), 0);
}

// A quarter of a circle of 1 m radius to the left. The origin comes pi/2 m, the left wheel of a 0.2 m track 0.9 of it,
// the right one 1.1.
TEST(TravelLog, DrivesAnArcInOneStep) {
  const std::vector<OdometrySample> poses = {pose(0, 0, 0, 0), pose(1, 1, 1, 1.5708)};
  const Travel travel = TravelLog(poses).at(base::Time::nearest(1));
  EXPECT_NEAR(travel.distance, std::numbers::pi / 2, 1e-4);
  EXPECT_NEAR(travel.left(0.2), 0.9 * std::numbers::pi / 2, 1e-4);
  EXPECT_NEAR(travel.right(0.2), 1.1 * std::numbers::pi / 2, 1e-4);
}

TEST(TravelLog, TurnsTheShortWayAcrossPi) {
  const std::vector<OdometrySample> poses = {pose(0, 0, 0, 3.1), pose(1, 0, 0, -3.1)};
  EXPECT_NEAR(TravelLog(poses).at(base::Time::nearest(1)).heading, 2 * std::numbers::pi - 6.2, 1e-9);
}

TEST(TravelLog, TellsWayThatNoWheelCan) {
  const std::vector<OdometrySample> poses = {pose(0, 0, 0, 0), pose(1, 0, 0.5, 0)};
  EXPECT_NEAR(TravelLog(poses).sideways(), 0.5, 2e-4);
  EXPECT_DOUBLE_EQ(TravelLog(poses).at(base::Time::nearest(1)).distance, 0);
}

// Ten minutes at 50 Hz of a random walk of speeds and turns. The driver's own integration of the rounded counts comes
// back to the pose. The remainder is the poses' rounding to 0.1 mm, which walks: sqrt(30000) steps of 0.03 mm.
TEST(TravelLog, CountsDoNotDrift) {
  std::mt19937 random(5);
  std::vector<OdometrySample> poses = {{}};
  double x = 0;
  double y = 0;
  double heading = 0;
  double turn = 0;
  for (int i = 1; i <= 30'000; ++i) {
    turn = 0.98 * turn + 1e-3 * (static_cast<double>(random() % 201) - 100) / 100;
    const double half = turn / 2;
    const double chord = 0.006 * (half == 0 ? 1 : std::sin(half) / half);
    x += chord * std::cos(heading + half);
    y += chord * std::sin(heading + half);
    heading += turn;
    poses.push_back(pose(0.02 * i, x, y, heading));
  }
  const TravelLog log(poses);
  constexpr odometry::WheelBase kWheels = odometry::kCreate2Wheels;
  const double tick = static_cast<double>(kWheels.left_pm_per_count) * 1e-12;
  const double track = static_cast<double>(kWheels.track_pm) * 1e-12;
  odometry::DifferentialDrive drive(kWheels);
  OdometrySample last;
  for (const OdometrySample& sample : poses) {
    const Travel travel = log.at(sample.t);
    const auto raw = [&](double way) { return static_cast<std::uint16_t>(counts_of(way, tick)); };
    last = drive.take(raw(travel.left(track)), raw(travel.right(track)), sample.t);
  }
  EXPECT_EQ(drive.resets(), 0U);
  // A count of one wheel is 0.4446 / 235 = 1.9 mrad of heading.
  EXPECT_NEAR(std::remainder(last.heading.to_double() - heading, 2 * std::numbers::pi), 0, 0.002);
  EXPECT_NEAR(last.x.to_double(), x, 0.03);
  EXPECT_NEAR(last.y.to_double(), y, 0.03);
  EXPECT_GT(std::hypot(x, y), 1) << "it went somewhere";
}

}  // namespace
}  // namespace fencepost::emulate
