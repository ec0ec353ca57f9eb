#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "host/import/import.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

// Straight on at 2 m/s for half a second, then a turn.
constexpr const char* kInputs = "1.0 2.0 0.0\n1.5 1.0 0.3\n2.5 0.0 0.0\n";
// One trunk ahead, one to the right, which is outside the image; then the lens is inside one.
constexpr const char* kTrunks = "1.2 10.0 1.5707963 0.5\n1.2 10.0 0.1 0.5\n1.4 0.2 1.5 0.5\n";

ImportResult import_with(const Files& files, const VictoriaOptions& options, const char* inputs = kInputs,
                         const char* trunks = kTrunks) {
  files.put("inputs.dat", inputs);
  files.put("measurements.dat", trunks);
  return import_victoria(files.folder(), options);
}

TEST(ImportVictoria, SpeedAndSteeringBecomeACarAndTrunksBoxes) {
  const Files files;
  const ImportResult result = import_with(files, {});
  const Recorded log = recorded(result);
  ASSERT_EQ(log.cars.size(), 3U);
  EXPECT_EQ(log.cars[1].t.raw, 5'000) << "times from the first";
  EXPECT_EQ(log.cars[1].count, 1'000) << "1 m at a tenth";
  // 1 / (1 - tan(0.3) * 0.76 / 2.83) = 1.0906 m more: the wheel with the encoder is on the inner circle.
  EXPECT_EQ(log.cars[2].count, 2'091);
  EXPECT_EQ(log.cars[1].steering, base::Radians::nearest(0.3));
  EXPECT_NE(result->log.find("$FPCFG,car.wheelbase,0.283"), std::string::npos);
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[0].blobs.size(), 1U);
  const auto& blob = log.frames[0].blobs[0];
  // asin(0.25 / 10) = 0.025003; 1308.5 -+ 25.003, half a pixel inwards.
  EXPECT_EQ(blob.x1, 1'284);
  EXPECT_EQ(blob.x2, 1'333);
  EXPECT_EQ(blob.y2, 1'200) << "no rows";
  EXPECT_TRUE(log.frames[1].blobs.empty()) << "the lens is inside the trunk";
  EXPECT_EQ(result->summary.skipped[0], (std::pair<std::string, std::uint64_t>{"trunks outside the camera's view", 2}));
}

TEST(ImportVictoria, RowsGiveTheRangeAndTheWindowItsTimes) {
  const Files files;
  VictoriaOptions options;
  options.rows = true;
  options.to = 2;
  const Recorded log = recorded(import_with(files, options));
  EXPECT_EQ(log.cars.size(), 2U);
  // atan(2 / 9.75) = 0.202320; 600 + 202.32 - 0.5.
  EXPECT_EQ(log.frames[0].blobs[0].y2, 802);
  options.from = 5;
  options.to.reset();
  EXPECT_EQ(import_with(files, options).error().where, "the window");
}

TEST(ImportVictoria, RefusesWhatCannotBe) {
  const Files files;
  VictoriaOptions options;
  options.scale = 2;
  EXPECT_EQ(import_with(files, options).error().where, "--scale");
  EXPECT_EQ(import_with(files, {}, "2 0 0\n1 0 0\n").error().where, files.folder() + "/inputs.dat:2");
  EXPECT_EQ(import_with(files, {}, kInputs, "1 2 3\n").error().where, files.folder() + "/measurements.dat:1");
  const Files empty;
  EXPECT_EQ(import_victoria(empty.folder(), {}).error().where, empty.folder() + "/inputs.dat");
}

TEST(VictoriaData, HasItsTrunks) {
  const std::string shared = std::string(FENCEPOST_SHARED_DIR) + "/data/world/victoria/";
  if (!std::filesystem::exists(shared)) {
    std::cerr << "\n*** SKIPPED: no Victoria Park data beside the checkout; nothing was compared ***\n";
    GTEST_SKIP() << "data/world/victoria is not there";
  }
  const Files files;
  for (const std::string name : {"inputs.dat", "measurements.dat"})
    std::filesystem::create_symlink(shared + name + ".first_half", files.folder() + "/" + name);
  const ImportResult result = import_victoria(files.folder(), {});
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_GT(result->summary.frames, 3'000U);
  EXPECT_GT(result->summary.blobs, 25'000U);
}

}  // namespace
}  // namespace fencepost::host
