#include "drivers/odometry/car_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "drivers/odometry/wheel_base.hpp"

namespace fencepost::odometry {
namespace {

constexpr std::int64_t kPicometresPerMetre = 1'000 * kPicometresPerMillimetre;
constexpr double kQuarterTurn = std::numbers::pi / 2;

/// 2000 counts a metre, axles 0.2 m apart.
CarGeometry car() {
  CarGeometry car;
  car.pm_per_count = kPicometresPerMetre / 2'000;
  car.wheelbase_um = 200'000;
  return car;
}

sensor::CarSample reading(double t, std::int32_t count, std::optional<double> rate, std::optional<double> angle = {}) {
  sensor::CarSample sample{base::Time::nearest(t), count, {}, {}};
  if (rate) sample.yaw_rate = base::RadiansPerSecond::nearest(*rate);
  if (angle) sample.steering = base::Radians::nearest(*angle);
  return sample;
}

/// 50 readings a second, from `t` on for so many seconds; counts a reading.
sensor::OdometrySample drive(CarDrive& drive, double& t, std::int32_t& count, double seconds, std::int32_t step,
                             std::optional<double> rate, std::optional<double> angle = {},
                             const CarGeometry& geometry = car()) {
  sensor::OdometrySample pose;
  for (int i = 0; i < static_cast<int>(std::lround(seconds * 50)); ++i) {
    t += 0.02;
    count += step;
    pose = drive.take(reading(t, count, rate, angle), geometry);
  }
  return pose;
}

struct Bench {
  CarDrive car;
  double t = 0;
  std::int32_t count = 0;
  sensor::OdometrySample go(double seconds, std::int32_t step, std::optional<double> rate,
                            std::optional<double> angle = {}, const CarGeometry& geometry = odometry::car()) {
    return drive(car, t, count, seconds, step, rate, angle, geometry);
  }
};

TEST(CarDrive, AQuarterCircleBySteeringAngle) {
  // tan(angle) = wheelbase / radius = 0.2 / 0.5. A quarter of it is 0.785 m, 1571 counts: 1 more than 157 readings
  // of 10.
  Bench bench;
  const double angle = std::atan(0.2 / 0.5);
  bench.car.take(reading(0, 0, {}, angle), car());
  const sensor::OdometrySample pose = bench.go(3.14, 10, {}, angle);
  EXPECT_NEAR(pose.x.to_double(), 0.5, 1e-3);
  EXPECT_NEAR(pose.y.to_double(), 0.5, 1e-3);
  EXPECT_NEAR(pose.heading.to_double(), kQuarterTurn, 2e-3);
}

TEST(CarDrive, AQuarterCircleByGyro) {
  // 0.25 m/s at 0.5 rad/s: a radius of 0.5 m.
  Bench bench;
  bench.car.take(reading(0, 0, 0.5), car());
  const sensor::OdometrySample pose = bench.go(kQuarterTurn / 0.5, 10, 0.5);
  EXPECT_NEAR(pose.x.to_double(), 0.5, 1e-3);
  EXPECT_NEAR(pose.y.to_double(), 0.5, 1e-3);
  EXPECT_NEAR(pose.heading.to_double(), 0.5 * 3.14, 1e-4);
}

TEST(CarDrive, BackwardsItTurnsTheOtherWay) {
  Bench bench;
  const double angle = std::atan(0.2 / 0.5);
  bench.car.take(reading(0, 0, {}, angle), car());
  const sensor::OdometrySample pose = bench.go(3.14, -10, {}, angle);
  EXPECT_NEAR(pose.x.to_double(), -0.5, 1e-3);
  EXPECT_NEAR(pose.y.to_double(), 0.5, 1e-3);
  EXPECT_NEAR(pose.heading.to_double(), -kQuarterTurn, 2e-3);
}

TEST(CarDrive, WhatTheGyroSaysWhileItStandsIsItsBias) {
  Bench bench;
  bench.car.take(reading(0, 0, 0.05), car());
  bench.go(1.0, 0, 0.05);
  ASSERT_TRUE(bench.car.learnt_bias());
  EXPECT_NEAR(*bench.car.learnt_bias(), 0.05, 1e-6);
  const sensor::OdometrySample pose = bench.go(4.0, 10, 0.05);
  EXPECT_EQ(pose.heading.raw, 0) << "straight on, whatever the gyro's bias";
  EXPECT_EQ(pose.x.raw, 10'000);
}

TEST(CarDrive, AFewReadingsAreNoStandstillHoweverLongTheyLast) {
  Bench bench;
  for (int i = 0; i < 5; ++i) bench.car.take(reading(0.2 * i, 0, 0.05), car());  // 0.8 s, four of them after the first
  EXPECT_FALSE(bench.car.learnt_bias());
  bench.car.take(reading(1.0, 0, 0.05), car());
  EXPECT_TRUE(bench.car.learnt_bias());
}

TEST(CarDrive, WithoutAStandstillTheSettingIsTheBias) {
  CarGeometry told = car();
  told.gyro_bias_urad_s = 50'000;
  Bench bench;
  bench.car.take(reading(0, 0, 0.05), told);
  EXPECT_EQ(bench.go(4.0, 10, 0.05, {}, told).heading.raw, 0);
  EXPECT_FALSE(bench.car.learnt_bias());
  Bench untold;
  untold.car.take(reading(0, 0, 0.05), car());
  EXPECT_NEAR(untold.go(4.0, 10, 0.05).heading.to_double(), 0.2, 1e-4);
}

TEST(CarDrive, ATurnByHandIsNoBias) {
  Bench bench;
  bench.car.take(reading(0, 0, 0.01), car());
  bench.go(1.0, 0, 0.01);
  bench.go(1.0, 0, 0.51);
  EXPECT_NEAR(*bench.car.learnt_bias(), 0.01, 1e-6);
  // The mean of two rates at its begin takes half a reading, 0.005 rad.
  EXPECT_NEAR(bench.go(0.02, 0, 0.01).heading.to_double(), 0.5, 2e-3);
}

TEST(CarDrive, AWarmingGyroIsFollowedAtEachStop) {
  Bench bench;
  bench.car.take(reading(0, 0, 0.010), car());
  bench.go(1.0, 0, 0.010);
  bench.go(10.0, 0, 0.020);
  EXPECT_NEAR(*bench.car.learnt_bias(), 0.020, 1e-4);
}

TEST(CarDrive, ScaleAndOffsetAreTakenOut) {
  CarGeometry told = car();
  told.gyro_scale = -5'000;  // clockwise is positive, and twice too much
  Bench gyro;
  gyro.car.take(reading(0, 0, -1.0), told);
  EXPECT_NEAR(gyro.go(1.0, 10, -1.0, {}, told).heading.to_double(), 0.5, 1e-4);

  told = car();
  told.steer_scale = 500;
  told.steer_offset_urad = 100'000;
  Bench steering;
  steering.car.take(reading(0, 0, {}, 0.1), told);
  EXPECT_EQ(steering.go(1.0, 10, {}, 0.1, told).heading.raw, 0);
  const double turned = 0.25 * std::tan(0.2) / 0.2;  // of a quarter of a metre, wheels at (0.5 - 0.1) / 2
  Bench turning;
  turning.car.take(reading(0, 0, {}, 0.5), told);
  EXPECT_NEAR(turning.go(1.0, 10, {}, 0.5, told).heading.to_double(), turned, 1e-4);
}

TEST(CarDrive, CountsWrapAndEncodersRestart) {
  Bench bench;
  bench.count = 2'147'483'640;
  bench.car.take(reading(0, bench.count, 0), car());
  bench.t = 0.02;
  const sensor::OdometrySample wrapped = bench.car.take(reading(0.02, -2'147'483'646, 0), car());
  EXPECT_EQ(wrapped.x.raw, 50) << "10 counts of 0.5 mm";
  const sensor::OdometrySample restarted = bench.car.take(reading(0.04, 0, 0), car());
  EXPECT_EQ(restarted.x.raw, 50);
  EXPECT_EQ(bench.car.take(reading(0.06, 10, 0), car()).x.raw, 100);
}

TEST(CarDrive, SaysWhatIsMissing) {
  CarGeometry untold;
  EXPECT_EQ(problem_of(reading(0, 0, 0.1), untold), CarProblem::kNoCounts);
  untold.pm_per_count = 1;
  EXPECT_EQ(problem_of(reading(0, 0, {}), untold), CarProblem::kNoHeading);
  EXPECT_EQ(problem_of(reading(0, 0, {}, 0.1), untold), CarProblem::kNoWheelbase);
  EXPECT_EQ(problem_of(reading(0, 0, 0.1), untold), CarProblem::kNone);
  EXPECT_EQ(problem_of(reading(0, 0, {}, 0.1), car()), CarProblem::kNone);
}

}  // namespace
}  // namespace fencepost::odometry
