#include "drivers/odometry/car_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
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
  CarGeometry configured = car();
  configured.gyro_bias_urad_s = 50'000;
  Bench bench;
  bench.car.take(reading(0, 0, 0.05), configured);
  EXPECT_EQ(bench.go(4.0, 10, 0.05, {}, configured).heading.raw, 0);
  EXPECT_FALSE(bench.car.learnt_bias());
  Bench unconfigured;
  unconfigured.car.take(reading(0, 0, 0.05), car());
  EXPECT_NEAR(unconfigured.go(4.0, 10, 0.05).heading.to_double(), 0.2, 1e-4);
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
  CarGeometry configured = car();
  configured.gyro_scale = -5'000;  // clockwise is positive, and twice too much
  Bench gyro;
  gyro.car.take(reading(0, 0, -1.0), configured);
  EXPECT_NEAR(gyro.go(1.0, 10, -1.0, {}, configured).heading.to_double(), 0.5, 1e-4);

  configured = car();
  configured.steer_scale = 500;
  configured.steer_offset_urad = 100'000;
  Bench steering;
  steering.car.take(reading(0, 0, {}, 0.1), configured);
  EXPECT_EQ(steering.go(1.0, 10, {}, 0.1, configured).heading.raw, 0);
  const double turned = 0.25 * std::tan(0.2) / 0.2;  // of a quarter of a metre, wheels at (0.5 - 0.1) / 2
  Bench turning;
  turning.car.take(reading(0, 0, {}, 0.5), configured);
  EXPECT_NEAR(turning.go(1.0, 10, {}, 0.5, configured).heading.to_double(), turned, 1e-4);
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

/// In 10^-4 s and 10^-4 rad/s or rad.
sensor::CarSample raw_reading(std::int64_t t, std::int32_t count, std::optional<std::int32_t> rate,
                              std::optional<std::int32_t> angle = {}) {
  sensor::CarSample sample{base::Time{t}, count, {}, {}};
  if (rate) sample.yaw_rate = base::RadiansPerSecond{*rate};
  if (angle) sample.steering = base::Radians{*angle};
  return sample;
}

TEST(CarDrive, TimeThatStandsStillOrRunsBackMovesNothing) {
  CarDrive drive;
  drive.take(raw_reading(1'000, 0, 10'000), car());
  EXPECT_EQ(drive.take(raw_reading(1'000, 10, 10'000), car()).x.raw, 0);
  EXPECT_EQ(drive.take(raw_reading(900, 20, 10'000), car()).x.raw, 0);
  const sensor::OdometrySample pose = drive.take(raw_reading(1'000, 30, 10'000), car());
  EXPECT_EQ(pose.x.raw, 50) << "10 counts from the reading before";
  EXPECT_EQ(pose.heading.raw, 100);
}

// 5 m/s for the time and 0.1 s of lateness: 0.12 s are 1200 counts of 0.5 mm; and for no more than 10 s.
TEST(CarDrive, MoreCountsThanACarCanMoveAreARestart) {
  for (const std::int64_t pm : {500'000'000, -500'000'000}) {
    CarGeometry geometry = car();
    geometry.pm_per_count = pm;
    const std::int32_t forward = pm > 0 ? 1 : -1;
    for (const auto& [passed, most] :
         {std::pair(200, 1'200), {99'999, 100'999}, {100'000, 101'000}, {200'000, 101'000}}) {
      for (const std::int32_t sign : {1, -1}) {
        CarDrive possible;
        possible.take(raw_reading(0, 0, 0), geometry);
        EXPECT_EQ(possible.take(raw_reading(passed, sign * most, 0), geometry).x.raw, forward * sign * most * 5)
            << passed;
        CarDrive restarted;
        restarted.take(raw_reading(0, 0, 0), geometry);
        EXPECT_EQ(restarted.take(raw_reading(passed, sign * (most + 1), 0), geometry).x.raw, 0) << passed;
      }
    }
  }
}

TEST(CarDrive, AGyroThatWasSilentTurnsForTenSecondsAtMost) {
  for (const auto& [passed, heading] : {std::pair(100'000, 10'000), {100'001, 10'000}, {500'000, 10'000}}) {
    CarDrive drive;
    drive.take(raw_reading(0, 0, 1'000), car());
    EXPECT_EQ(drive.take(raw_reading(passed, 1, 1'000), car()).heading.raw, heading) << passed;
  }
}

// The rate is the mean of two readings: without one of them it is the steering angle that turns the car.
TEST(CarDrive, OneRateAloneTurnsByTheSteeringAngle) {
  const std::int32_t angle = 3'805;  // tan 0.3805 rad: 0.4
  const auto turned = [&](const sensor::CarSample& first, const sensor::CarSample& second,
                          const CarGeometry& geometry) {
    CarDrive drive;
    drive.take(first, geometry);
    return drive.take(second, geometry).heading.raw;
  };
  const std::int32_t by_angle = turned(raw_reading(0, 0, {}, angle), raw_reading(200, 10, {}, angle), car());
  EXPECT_EQ(by_angle, 100) << "5 mm by a radius of 0.5 m";
  EXPECT_EQ(turned(raw_reading(0, 0, 5'000, angle), raw_reading(200, 10, {}, angle), car()), by_angle);
  EXPECT_EQ(turned(raw_reading(0, 0, {}, angle), raw_reading(200, 10, 5'000, angle), car()), by_angle);
  EXPECT_EQ(turned(raw_reading(0, 0, 5'000, angle), raw_reading(200, 10, 7'000, angle), car()), 120) << "0.6 rad/s";
  EXPECT_EQ(turned(raw_reading(0, 0, 5'000), raw_reading(200, 10, {}, angle), car()), 0) << "no angle before";
  EXPECT_EQ(turned(raw_reading(0, 0, {}, angle), raw_reading(200, 10, 5'000), car()), 0) << "none now";
  CarGeometry no_wheelbase = car();
  no_wheelbase.wheelbase_um = 0;
  EXPECT_EQ(turned(raw_reading(0, 0, {5'000}, angle), raw_reading(200, 10, 5'000, {}), no_wheelbase), 100);
  CarDrive gyro_lost;
  gyro_lost.take(raw_reading(0, 0, 5'000, angle), no_wheelbase);
  gyro_lost.take(raw_reading(200, 10, 5'000, angle), no_wheelbase);
  EXPECT_EQ(gyro_lost.take(raw_reading(400, 20, 5'000, angle), no_wheelbase).heading.raw, 200);
}

// The setting was taken back between two readings, and the gyro is heard of with the second only.
TEST(CarDrive, AnUnknownWheelbaseTurnsNothing) {
  CarDrive drive;
  drive.take(raw_reading(0, 0, {}, 3'000), car());
  CarGeometry geometry = car();
  geometry.wheelbase_um = 0;
  const sensor::OdometrySample pose = drive.take(raw_reading(200, 10, 5'000, 3'000), geometry);
  EXPECT_EQ(pose.x.raw, 50);
  EXPECT_EQ(pose.heading.raw, 0);
}

TEST(CarDrive, WheelsTurnNoFurtherThanATangentIsTakenOf) {
  const auto turned = [&](std::int32_t angle) {
    CarDrive drive;
    drive.take(raw_reading(0, 0, {}, angle), car());
    return drive.take(raw_reading(200, 10, {}, angle), car()).heading.raw;
  };
  EXPECT_EQ(turned(13'000), turned(15'000));
  EXPECT_EQ(turned(-13'000), turned(-15'000));
  EXPECT_GT(turned(13'000), turned(12'950));
  EXPECT_EQ(turned(13'000), -turned(-13'000));
}

// 100 m at 5 m/s on a circle of 0.5 m radius: 200 rad, of which a part in 16384 would be 120.
TEST(CarDrive, ManyTurnsBySteeringAngleAreNotLost) {
  CarDrive drive;
  const std::int32_t angle = 3'805;
  drive.take(raw_reading(0, 0, {}, angle), car());
  sensor::OdometrySample pose;
  for (std::int32_t i = 1; i <= 1'000; ++i) pose = drive.take(raw_reading(200 * i, 200 * i, {}, angle), car());
  const double turned = 100 * std::tan(0.3805) / 0.2;
  EXPECT_NEAR(pose.heading.to_double(), std::remainder(turned, 2 * std::numbers::pi), 3e-4);
}

/// The learnt bias, in 10^-4 rad/s, from readings 0.1 s apart.
std::optional<double> learnt(CarDrive& drive, std::int64_t& t, std::initializer_list<std::int32_t> rates) {
  for (const std::int32_t rate : rates) drive.take(raw_reading(t += 1'000, 0, rate), car());
  const std::optional<double> bias = drive.learnt_bias();
  return bias ? std::optional(*bias * 10'000) : std::nullopt;
}

TEST(CarDrive, AStandstillLastsHalfASecondAndFiveReadings) {
  CarDrive drive;
  std::int64_t t = -1'000;
  EXPECT_EQ(learnt(drive, t, {100, 100, 100, 100, 100}), std::nullopt) << "0.4 s";
  EXPECT_EQ(learnt(drive, t, {100}), 100.0) << "0.5 s, five after the first";
  CarDrive early;
  early.take(raw_reading(0, 0, 100), car());
  for (std::int64_t at = 1'000; at <= 4'000; at += 500) early.take(raw_reading(at, 0, 100), car());
  early.take(raw_reading(4'999, 0, 100), car());
  EXPECT_FALSE(early.learnt_bias());
  early.take(raw_reading(5'000, 0, 100), car());
  EXPECT_TRUE(early.learnt_bias());
}

TEST(CarDrive, AStandstillIsSteady) {
  for (const auto& [other, steady] : {std::pair(449, true), {450, false}, {-249, true}, {-250, false}}) {
    CarDrive drive;
    std::int64_t t = -1'000;
    const auto bias = learnt(drive, t, {100, 100, 100, other, 100, 100});
    EXPECT_EQ(bias.has_value(), steady) << other;
  }
}

TEST(CarDrive, AStandstillIsSlow) {
  for (const std::int32_t sign : {1, -1}) {
    CarDrive slow;
    std::int64_t t = -1'000;
    const std::int32_t most = sign * 3'491;
    EXPECT_EQ(learnt(slow, t, {most, most, most, most, most, most}), double{1.0 * most});
    CarDrive fast;
    t = -1'000;
    const std::int32_t more = sign * 3'492;
    EXPECT_EQ(learnt(fast, t, {more, more, more, more, more, more}), std::nullopt);
  }
}

// A later one counts for a quarter, and may be off by 3 deg/s.
TEST(CarDrive, ABiasThatHasChangedTooMuchIsAHand) {
  for (const std::int32_t sign : {1, -1}) {
    for (const std::int32_t change : {524, 525, 400}) {
      CarDrive drive;
      std::int64_t t = -1'000;
      ASSERT_EQ(learnt(drive, t, {1'000, 1'000, 1'000, 1'000, 1'000, 1'000}), 1'000.0);
      const std::int32_t next = 1'000 + sign * change;
      EXPECT_EQ(learnt(drive, t, {next, next, next, next, next, next}),
                change <= 524 ? 1'000.0 + sign * change / 4.0 : 1'000.0);
    }
  }
}

TEST(CarDrive, AStandstillThatIsInterruptedBeginsAnew) {
  CarDrive moved;
  std::int64_t t = -1'000;
  EXPECT_EQ(learnt(moved, t, {100, 100, 100, 100}), std::nullopt);
  moved.take(raw_reading(t += 1'000, 1, 100), car());
  moved.take(raw_reading(t += 1'000, 0, 100), car());
  EXPECT_EQ(learnt(moved, t, {100, 100, 100, 100}), std::nullopt);
  EXPECT_EQ(learnt(moved, t, {100}), 100.0);
  CarDrive without;  // a reading
  t = -1'000;
  EXPECT_EQ(learnt(without, t, {100, 100, 100, 100}), std::nullopt);
  without.take(raw_reading(t += 1'000, 0, {}, 0), car());
  EXPECT_EQ(learnt(without, t, {100, 100, 100, 100}), std::nullopt);
  EXPECT_EQ(learnt(without, t, {100}), 100.0);
}

TEST(CarDrive, ABiasConfiguredIsTakenOutToItsTenThousandth) {
  CarGeometry configured = car();
  configured.gyro_bias_urad_s = 150;  // 1.5 of 10^-4 rad/s
  CarDrive drive;
  drive.take(raw_reading(0, 0, 10), configured);
  EXPECT_EQ(drive.take(raw_reading(80'000, 1, 10), configured).heading.raw, 68) << "8.5 of them for 8 s";
}

TEST(CarDrive, SaysWhatIsMissing) {
  CarGeometry unconfigured;
  EXPECT_EQ(problem_of(reading(0, 0, 0.1), unconfigured), CarProblem::kNoCounts);
  unconfigured.pm_per_count = 1;
  EXPECT_EQ(problem_of(reading(0, 0, {}), unconfigured), CarProblem::kNoHeading);
  EXPECT_EQ(problem_of(reading(0, 0, {}, 0.1), unconfigured), CarProblem::kNoWheelbase);
  EXPECT_EQ(problem_of(reading(0, 0, 0.1), unconfigured), CarProblem::kNone);
  EXPECT_EQ(problem_of(reading(0, 0, {}, 0.1), car()), CarProblem::kNone);
}

}  // namespace
}  // namespace fencepost::odometry
