#include "firmware/recon/models/row_trend.hpp"

#include <gtest/gtest.h>

#include <random>

#include "firmware/recon/models/cylinder.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using recon::RowTrend;
using recon::RowVerdict;
using recon::Vec2;

constexpr float kFront = 1;       // m, where the object begins
constexpr float kRowPx = 1;       // sigma
constexpr float kFocal = 270;     // px
constexpr float kHeight = 0.12F;  // m, of the lens

// A robot that drives straight at an object from `from` m on; rows say `told` times the true range, with noise.
class StraightDrive {
 public:
  explicit StraightDrive(float told) : told_(told) {}

  void to(float range, int views) {
    for (int i = 1; i <= views; ++i) {
      see(range_ + (range - range_) * static_cast<float>(i) / static_cast<float>(views), {1, 0});
    }
    range_ = range;
  }
  void see(float range, const Vec2& bearing) {
    const float said = told_ * range;
    const float sigma = said * said / kHeight * kRowPx / kFocal;
    std::normal_distribution<float> noise(0, sigma);
    trend.add({kFront - range, 0}, bearing, said + noise(random_), 1 / (sigma * sigma + 1e-5F));
    trend.judge();
  }

  RowTrend trend;

 private:
  float told_;
  float range_ = 1;
  std::mt19937 random_{1};
};

TEST(RowTrend, RowsOfWhatStandsOnTheFloorAreTrue) {
  StraightDrive drive(1);
  drive.to(0.95F, 20);
  EXPECT_EQ(drive.trend.verdict(), RowVerdict::kUnknown) << "after 5 cm nobody can tell";
  drive.to(0.3F, 60);
  EXPECT_EQ(drive.trend.verdict(), RowVerdict::kTrue);
  EXPECT_EQ(drive.trend.nearer(), 1);
}

// 3 cm of 12: rows say 4/3 of the range.
TEST(RowTrend, FindsWhatStandsOnABase) {
  StraightDrive drive(4.0F / 3);
  drive.to(0.5F, 60);
  ASSERT_EQ(drive.trend.verdict(), RowVerdict::kTooFar);
  EXPECT_NEAR(drive.trend.nearer(), 0.75F, 0.06F);
  const recon::HalfPlane plane = drive.trend.front().plane;
  EXPECT_NEAR(-plane.bound, kFront, 0.04F) << "where the line meets zero";
  EXPECT_EQ(plane.normal, Vec2(-1, 0));
  EXPECT_LT(drive.trend.front().variance, 0.04F * 0.04F);
}

TEST(RowTrend, SaysThatRowsAreTooNearButDoesNotActOnIt) {
  StraightDrive drive(0.75F);
  drive.to(0.4F, 60);
  EXPECT_EQ(drive.trend.verdict(), RowVerdict::kTooNear);
  EXPECT_GT(drive.trend.scale(), 1.2F);
  EXPECT_EQ(drive.trend.nearer(), 1);
}

TEST(RowTrend, ARobotThatStandsOrTurnsOnTheSpotLearnsNothing) {
  StraightDrive drive(4.0F / 3);
  for (int i = 0; i < 500; ++i) drive.see(0.5F, unit(0.001 * i));
  EXPECT_EQ(drive.trend.verdict(), RowVerdict::kUnknown);
}

TEST(RowTrend, MovingTheOriginChangesNothing) {
  StraightDrive drive(4.0F / 3);
  drive.to(0.5F, 60);
  const recon::HalfPlane before = drive.trend.front().plane;
  const Vec2 shift{0.25F, -0.5F};
  drive.trend.move_origin(shift);
  EXPECT_NEAR(drive.trend.front().plane.bound, before.bound - before.normal.dot(shift), 1e-5F);
}

// The map's own object, met straight on: its front is where it is, not where its foot seems to be.
TEST(RowTrend, PutsTheCylinderWhereItIs) {
  recon::Cylinder cylinder;
  const host::Point center{1.06, 0};
  for (int i = 0; i < 60; ++i) {
    const host::Point lens{0.01 * i, 0};
    recon::Sighting sighting = view_of_circle(center, 0.06, lens).sighting;
    sighting.rows_known = true;
    sighting.bottom = {static_cast<float>(0.09 / (1.0 - lens.x)), recon::End::kSeen};
    cylinder.add(sighting, {0, 0}, 1, {});
    cylinder.solve(sighting.lens_from({0, 0}), sighting.center, {});
  }
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_EQ(cylinder.row_trend().verdict(), RowVerdict::kTooFar);
  EXPECT_NEAR(cylinder.estimate().center.x() - cylinder.estimate().radius, kFront, 0.03F);
}

}  // namespace
}  // namespace fencepost::test
