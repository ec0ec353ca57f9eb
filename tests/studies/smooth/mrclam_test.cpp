// A real robot's 15 minutes by its commanded velocities: the optimum over the whole log, and what calibrate finds.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "host/calibrate/calibrate.hpp"
#include "host/import/import.hpp"
#include "host/smooth/smooth.hpp"
#include "host/smooth/truth_par.hpp"

namespace fencepost::host {
namespace {

const std::string kData = FENCEPOST_SHARED_DIR "/data/mrclam/";

class MrclamSmooth : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder())) GTEST_SKIP() << "NOT TESTED: " << folder() << " is not on this machine";
  }
  [[nodiscard]] static std::string folder() { return kData + GetParam(); }
};

TEST_P(MrclamSmooth, OptimumByOdometryAlone) {
  MrclamOptions options;
  options.poses = PoseSource::kOdometry;
  const ImportResult imported = import_mrclam(folder(), options);
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const SmoothOutcome outcome = smooth(imported->log, GetParam(), {});
  ASSERT_TRUE(outcome.smoothed) << outcome.refusal;
  const SmoothEvaluation par = evaluate_smoothed(*outcome.smoothed, *imported->truth, GetParam());
  std::printf("%s", smooth_evaluation_text({par}).c_str());
  EXPECT_EQ(par.optimum.pairs, 15U);
  EXPECT_LE(par.optimum.objects, 16U);
  EXPECT_LT(par.optimum.aligned, 0.25);
  EXPECT_LT(par.optimum.aligned, par.online.aligned);
}
INSTANTIATE_TEST_SUITE_P(DataSets, MrclamSmooth, ::testing::Values("D7_R2", "D6_R2"));

// With ranges as ground rows, where the online map is good, too: 0.4 times the optimum's error in D7, 1.3 times in D6.
TEST_P(MrclamSmooth, OptimumWithRows) {
  MrclamOptions options;
  options.poses = PoseSource::kOdometry;
  options.rows = true;
  const ImportResult imported = import_mrclam(folder(), options);
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const SmoothOutcome outcome = smooth(imported->log, GetParam(), {});
  ASSERT_TRUE(outcome.smoothed) << outcome.refusal;
  const SmoothEvaluation par = evaluate_smoothed(*outcome.smoothed, *imported->truth, GetParam());
  std::printf("%s", smooth_evaluation_text({par}).c_str());
  EXPECT_EQ(par.optimum.pairs, 15U);
  EXPECT_LT(par.optimum.aligned, 0.10);
  EXPECT_LT(par.online.aligned, 2 * par.optimum.aligned);
}

// The bearings' own bias against the survey is within 0.2 degrees in this run; what is found, within its sigma of that.
TEST(MrclamCalibrate, FindsTheBearingsBias) {
  const std::string folder = kData + "D7_R2";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "NOT TESTED: " << folder << " is not on this machine";
  MrclamOptions options;
  options.poses = PoseSource::kTruth;
  options.to = 240;
  const ImportResult imported = import_mrclam(folder, options);
  ASSERT_TRUE(imported.ok()) << imported.error().message();
  const CalibrateOutcome outcome = calibrate(imported->log, "D7_R2", {});
  ASSERT_TRUE(outcome.calibration) << outcome.refusal;
  for (const Finding& finding : outcome.calibration->findings) {
    if (finding.key != "yaw") continue;
    std::printf("  yaw %.2f +- %.2f degrees\n", finding.found, finding.sigma);
    EXPECT_TRUE(finding.observed);
    EXPECT_LT(std::abs(finding.found), 0.2 + finding.sigma);
    EXPECT_LT(finding.sigma, 0.4);
  }
}

}  // namespace
}  // namespace fencepost::host
