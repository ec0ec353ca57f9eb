// Whole calibrations of simulated drives: the numbers found, and the logs refused.
#include "host/calibrate/calibrate.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/calibrate/calibration_picture.hpp"
#include "host/calibrate/drive_log.hpp"
#include "tests/studies/calibrate/calibration_drive.hpp"

namespace fencepost::host {
namespace {

using test::calibration_drive;
using test::CalibrationDrive;
using test::DriveOptions;
using test::Motion;

const Finding& finding(const Calibration& calibration, std::string_view key) {
  for (const Finding& one : calibration.findings) {
    if (one.key == key) return one;
  }
  throw std::runtime_error("no such finding");
}

CalibrateOutcome run(const CalibrationDrive& drive, const CalibrateOptions& options = {}) {
  return calibrate(drive.log, "drive", options);
}

struct Calibrate : testing::Test {
  DriveOptions options;
};

// Without noise the only errors are those that the model does not have: corners, whole pixels.
TEST_F(Calibrate, FindsWhatWasConfiguredWrong) {
  options.seed = 501;
  options.noise = 0;
  options.drift = 0;
  const CalibrationDrive drive = calibration_drive(options);
  const CalibrateOutcome outcome = run(drive);
  ASSERT_TRUE(outcome.calibration) << outcome.refusal;
  const Calibration& found = *outcome.calibration;
  EXPECT_TRUE(found.complete());
  EXPECT_EQ(found.objects.size(), 4U);
  const auto error = [&](std::string_view key) {
    return std::abs(finding(found, key).found - test::true_value(drive, key));
  };
  EXPECT_LT(error("focal_length") / 273.6, 0.005);
  EXPECT_LT(error("yaw"), 0.15);  // 0.04 measured
  EXPECT_LT(error("pitch"), 0.3);
  EXPECT_LT(error("latency"), 4);
  EXPECT_LT(found.after.columns_px, 0.25 * found.before.columns_px);
  EXPECT_EQ(found.found.fx.raw, found.found.fy.raw);
  EXPECT_NEAR(found.found.mount.yaw.to_double(), drive.scene.camera.mount.yaw.to_double(), 0.016);
  const std::string picture = calibration_picture(found);
  EXPECT_NE(picture.find("<svg"), std::string::npos);
  EXPECT_EQ(picture.find("nan"), std::string::npos);
}

// Wide lenses show more: what the log names is fitted, edges and feet 70 degrees off the axis, too.
class FisheyeCalibrate : public testing::TestWithParam<double> {};
TEST_P(FisheyeCalibrate, FindsWhatWasConfiguredWrong) {
  DriveOptions options;
  options.seed = 503;
  options.fisheye = GetParam();
  const CalibrationDrive drive = calibration_drive(options);
  const CalibrateOutcome outcome = run(drive);
  ASSERT_TRUE(outcome.calibration) << outcome.refusal;
  const Calibration& found = *outcome.calibration;
  EXPECT_TRUE(found.complete());
  EXPECT_EQ(found.found.lens, sensor::Lens::kEquidistant);
  for (const std::string_view key : {"focal_length", "yaw", "pitch", "latency"}) {
    const Finding& one = finding(found, key);
    EXPECT_LT(std::abs(one.found - test::true_value(drive, key)), 3 * one.sigma) << key;
  }
  EXPECT_LT(finding(found, "focal_length").sigma / found.found.fx.to_double(), 0.005);
  EXPECT_LT(finding(found, "yaw").sigma, 0.5);
  EXPECT_LT(found.after.columns_px, 1.3);  // the noise of level 1
  EXPECT_LT(found.after.rows_px, 1.3);
}
INSTANTIATE_TEST_SUITE_P(DegreesAcross, FisheyeCalibrate, testing::Values(100, 120, 150));

// The odometry's metre is the unit until a length is known.
TEST_F(Calibrate, ADistanceTellsTheWheelsScale) {
  options.seed = 502;
  options.noise = 0.3;
  CalibrationDrive drive = calibration_drive(options);
  const CalibrateOutcome without = run(drive);
  ASSERT_TRUE(without.calibration) << without.refusal;
  EXPECT_FALSE(finding(*without.calibration, "wheel_scale").observed);

  const auto middle = [&](std::size_t i) {
    Point sum;
    const LinearRing& ring = drive.scene.objects[i].footprint.outer;
    for (const Point& p : ring) sum = {sum.x + p.x, sum.y + p.y};
    return Point{sum.x / static_cast<double>(ring.size()), sum.y / static_cast<double>(ring.size())};
  };
  const auto apart = [&](std::size_t i, std::size_t j) {
    return std::hypot(middle(i).x - middle(j).x, middle(i).y - middle(j).y);
  };
  CalibrateOptions known;
  // A world that is larger by a tenth than its odometry says.
  known.distances = {{"red", "blue", 1.1 * apart(0, 2)}, {"red", "green", 1.1 * apart(0, 1)}};
  const CalibrateOutcome with = run(drive, known);
  ASSERT_TRUE(with.calibration) << with.refusal;
  const Finding& scale = finding(*with.calibration, "wheel_scale");
  EXPECT_TRUE(scale.observed) << scale.found << " +- " << scale.sigma;
  EXPECT_NEAR(scale.found, 10, 3)
      << scale.sigma;  // the middle of a block that is an L is not the middle of what is seen of it
}

TEST_F(Calibrate, AColourThatIsNotThereIsAUsageError) {
  options.seed = 503;
  CalibrateOptions asked;
  asked.sizes = {{"purple", 0.05}};
  const CalibrateOutcome outcome = run(calibration_drive(options), asked);
  EXPECT_FALSE(outcome.calibration);
  EXPECT_TRUE(outcome.usage);
  EXPECT_NE(outcome.refusal.find("no colour \"purple\""), std::string::npos) << outcome.refusal;
}

// Pitch is: a foot's row changes as its block goes across the image.
TEST_F(Calibrate, OnTheSpotYawIsNotObserved) {
  options.seed = 504;
  options.motion = Motion::kSpin;
  const CalibrateOutcome outcome = run(calibration_drive(options));
  ASSERT_TRUE(outcome.calibration) << outcome.refusal;
  EXPECT_FALSE(outcome.calibration->complete());
  EXPECT_TRUE(finding(*outcome.calibration, "focal_length").observed);
  const Finding& yaw = finding(*outcome.calibration, "yaw");
  EXPECT_FALSE(yaw.observed) << yaw.sigma;
  EXPECT_NE(yaw.motion.find("on the spot tells nothing"), std::string_view::npos);
  EXPECT_EQ(outcome.calibration->found.mount.yaw, outcome.calibration->configured.mount.yaw);
}

TEST_F(Calibrate, StraightOnTheFocalLengthIsNotObserved) {
  options.seed = 505;
  options.motion = Motion::kStraight;
  const CalibrateOutcome outcome = run(calibration_drive(options));
  if (!outcome.calibration) {
    EXPECT_NE(outcome.refusal.find("blocks"), std::string::npos);
    return;
  }
  EXPECT_FALSE(finding(*outcome.calibration, "focal_length").observed);
  EXPECT_EQ(outcome.calibration->found.fx, outcome.calibration->configured.fx);
}

TEST_F(Calibrate, ARobotThatStandsIsAskedToDrive) {
  options.seed = 506;
  options.motion = Motion::kStanding;
  const CalibrateOutcome outcome = run(calibration_drive(options));
  EXPECT_FALSE(outcome.calibration);
  EXPECT_NE(outcome.refusal.find("hardly moves"), std::string::npos) << outcome.refusal;
}

TEST_F(Calibrate, OneBlockIsNotEnough) {
  options.seed = 507;
  options.blocks = 1;
  const CalibrateOutcome outcome = run(calibration_drive(options));
  EXPECT_FALSE(outcome.calibration);
  EXPECT_NE(outcome.refusal.find("at least 2"), std::string::npos) << outcome.refusal;
}

// The image cuts off a part of a blob: the foot of the rest is farther up than the nearest point would have it.
TEST(ReadDrive, ABlobThatIsCutOffTellsNoRows) {
  DriveOptions options;
  options.seed = 509;
  const CalibrationDrive drive = calibration_drive(options);
  ReplayOptions replay_options;
  replay_options.profile = "full";
  ReplayOutcome outcome;
  const DriveLog log = read_drive(drive.log, "drive", replay_options, outcome);
  std::size_t cut = 0;
  std::size_t whole = 0;
  for (const SeenFrame& frame : log.frames) {
    for (const SeenBox& box : frame.boxes) {
      const bool ends = box.left && box.right;
      whole += ends && box.foot ? 1U : 0U;
      cut += ends ? 0U : 1U;
      EXPECT_TRUE(ends || !(box.foot || box.top)) << frame.t;
    }
  }
  EXPECT_GT(cut, 20U);
  EXPECT_GT(whole, 200U);
}

TEST_F(Calibrate, SameBytesSameResult) {
  options.seed = 508;
  const CalibrationDrive drive = calibration_drive(options);
  const CalibrateOutcome a = run(drive);
  const CalibrateOutcome b = run(drive);
  ASSERT_TRUE(a.calibration && b.calibration);
  EXPECT_EQ(a.calibration->found, b.calibration->found);
}

}  // namespace
}  // namespace fencepost::host
