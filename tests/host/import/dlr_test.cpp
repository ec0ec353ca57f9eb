#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "host/import/dlr/dlr_files.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

/// A metre forward, a quarter turn to the left, a metre forward. The first image shows a disc 2 m ahead.
std::string put_steps(const Files& files) {
  return files.put("map.circles",
                   "# header\nSTEP a.0 0 -5 0 1 0 1 0 0 1\nLANDMARK_C 0 -2 0.9 1 0 1 7\nLANDMARK_C 3 0 0.9 1 0 1 8\n"
                   "STEP a.1 0 -1 -1.5707963 1 0 1 0 0 1\nLANDMARK_C 0.5 -2 0.9 1 0 1 -1\n"
                   "STEP a.2 0 -1 0 1 0 1 0 0 1\nLANDMARK_C 0 -2 0.9 1 0 1 9\n");
}

TEST(ImportDlr, StepsBecomePosesFromTheOriginAndDiscsBecomeBoxes) {
  const Files files;
  const ImportResult result = import_dlr(put_steps(files), {});
  const Recorded log = recorded(result);
  ASSERT_EQ(log.odometry.size(), 3U);
  EXPECT_EQ(log.odometry[0].x.raw, 0) << "the first motion is before the first image";
  EXPECT_EQ(log.odometry[1].x.raw, 10'000);
  EXPECT_EQ(log.odometry[2].y.raw, 10'000);
  EXPECT_EQ(log.odometry[2].t.raw, 10'000);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U) << "the disc to the right is outside the image";
  const auto& blob = log.frames[0].blobs[0];
  // asin(0.1 / 2) = 0.0500209; 5999.5 -+ 3600 tan(0.0500209) = 5819.27, 6179.73, half a pixel inwards.
  EXPECT_EQ(blob.x1, 5820);
  EXPECT_EQ(blob.x2, 6179);
  // The foot is 1.9 m ahead: 2999.5 + 3600 * 0.5 / 1.9 - 0.5 = 3946.37.
  EXPECT_EQ(blob.y2, 3946);
  EXPECT_EQ(blob.signature, 1);
  EXPECT_EQ(result->summary.skipped[0], (std::pair<std::string, std::uint64_t>{"discs outside the camera's view", 1}));
  EXPECT_FALSE(result->truth.has_value());
}

TEST(ImportDlr, IdentityNumbersDiscsByAppearanceAndUnknownOnesLast) {
  const Files files;
  DlrOptions options;
  options.identity = true;
  const Recorded log = recorded(import_dlr(put_steps(files), options));
  EXPECT_EQ(log.frames[0].blobs[0].signature, 1);
  EXPECT_EQ(log.frames[1].blobs[0].signature, 32);
  EXPECT_EQ(log.frames[2].blobs[0].signature, 2);
}

TEST(ImportDlr, AWindowStartsAtTheOrigin) {
  const Files files;
  DlrOptions options;
  options.from = 1;
  options.to = 2;
  const std::string file = put_steps(files);
  const Recorded log = recorded(import_dlr(file, options));
  ASSERT_EQ(log.odometry.size(), 1U);
  EXPECT_EQ(log.odometry[0].x.raw, 0);
  EXPECT_EQ(log.odometry[0].t.raw, 0);
  options.from = 3;
  options.to.reset();
  EXPECT_EQ(import_dlr(file, options).error().where, "the window");
}

class DamagedDlr : public testing::TestWithParam<Damage> {};

TEST_P(DamagedDlr, IsRefusedWithFileAndLine) {
  const Files files;
  expect_refused(import_dlr(files.put(GetParam().file, GetParam().text), {}), files, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Files, DamagedDlr,
    testing::Values(Damage{"m", "", "/m", "is empty"}, Damage{"m", "STEP a 0 0\n", "/m:1", "4 columns instead of 5"},
                    Damage{"m", "LANDMARK_C 0 -2 0.9 1 0 1 7\n", "/m:1", "before the first step"},
                    Damage{"m", "STEP a 0 0 0\nLANDMARK_C 0 x 0.9 1 0 1 7\n", "/m:2", "not a number"},
                    Damage{"m", "STEP a 0 0 0\nLANDMARK 1 2\n", "/m:2", "neither STEP nor LANDMARK_C"}));

/// The file, or nothing, loudly.
std::optional<std::string> dlr_data() {
  const std::string file = std::string(FENCEPOST_SHARED_DIR) + "/data/world/dlr/map.circles.first_half";
  if (std::filesystem::exists(file)) return file;
  std::cerr << "\n*** SKIPPED: no DLR data beside the checkout; nothing was compared ***\n";
  return std::nullopt;
}

TEST(DlrData, HasItsSteps) {
  const std::optional<std::string> file = dlr_data();
  if (!file) GTEST_SKIP() << "data/world/dlr is not there";
  const ImportResult result = import_dlr(*file, {});
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(result->summary.frames, read_dlr(*file).size());
  EXPECT_GT(result->summary.blobs, 5'000U);
}

// 1 cm (median). If turns were mirrored it would be 10 cm.
TEST(DlrData, ADiscStaysWhereItIsWhileTheRobotTurns) {
  const std::optional<std::string> file = dlr_data();
  if (!file) GTEST_SKIP() << "data/world/dlr is not there";
  const std::vector<DlrStep> steps = read_dlr(*file);
  std::vector<double> off;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const DlrStep& step = steps[i];
    if (std::abs(step.turn) < 0.05) continue;
    for (const DlrDisc& before : steps[i - 1].discs) {
      const auto now = std::ranges::find(step.discs, before.id, &DlrDisc::id);
      if (before.id < 0 || now == step.discs.end()) continue;
      const double c = std::cos(step.turn), s = std::sin(step.turn);
      off.push_back(std::hypot(step.forward + c * now->x - s * now->y - before.x,
                               step.left + s * now->x + c * now->y - before.y));
    }
  }
  ASSERT_GT(off.size(), 1'000U);
  std::ranges::nth_element(off, off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2));
  EXPECT_LT(off[off.size() / 2], 0.05);
}

}  // namespace
}  // namespace fencepost::host
