#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>

#include "host/import/import.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

constexpr const char* kDrive = "0.05 0.0 -0.01 2\n-0.2\n0.25\n0.05 12.5 0.5 0\n0.1 25 0.25 1\n1.5\n";
constexpr const char* kCones = "2\n0. -340.375\n626.5 340.375\n";

TEST(ImportCycloid, FramesBecomeACarAndBearings) {
  const Files files;
  const ImportResult result = import_cycloid(files.put("drive.txt", kDrive), files.put("lm.txt", kCones));
  const Recorded log = recorded(result);
  ASSERT_EQ(log.cars.size(), 4U);
  EXPECT_EQ(log.cars[0].count, 0);
  EXPECT_EQ(log.cars[3].t.raw, 2'000);
  EXPECT_EQ(log.cars[3].count, 3'750) << "0.375 m";
  EXPECT_EQ(log.cars[2].yaw_rate, base::RadiansPerSecond::nearest(0.5));
  EXPECT_FALSE(log.cars[2].steering.has_value());
  ASSERT_EQ(log.frames.size(), 3U);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  EXPECT_TRUE(log.frames[0].blobs[0].bearing);
  // 261 + 200 * 0.25 = 311: to the right is right in the image.
  EXPECT_EQ(log.frames[0].blobs[1].cx.raw, 3'110);
  EXPECT_TRUE(log.frames[1].blobs.empty());
  EXPECT_TRUE(log.frames[2].blobs.empty()) << "1.5 rad is outside the image";
  EXPECT_NE(result->log.find("$FPCFG,car.counts,10000.0"), std::string::npos);
  ASSERT_TRUE(result->truth);
  ASSERT_EQ(result->truth->objects.size(), 2U);
  EXPECT_EQ(result->truth->objects[1].name, "cone 2");
}

class DamagedCycloid : public testing::TestWithParam<Damage> {};

TEST_P(DamagedCycloid, IsRefusedWithFileAndLine) {
  const Files files;
  const bool cones = GetParam().file == std::string("lm.txt");
  const std::string damaged = files.put(GetParam().file, GetParam().text);
  expect_refused(cones ? import_cycloid(files.put("drive.txt", kDrive), damaged) : import_cycloid(damaged, ""), files,
                 GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Files, DamagedCycloid,
    testing::Values(Damage{"d", "", "/d", "is empty"}, Damage{"d", "0.1 0 0\n", "/d:1", "3 columns instead of 4"},
                    Damage{"d", "0.1 0 0 0\n0 0 0 0\n", "/d:2", "a step of no time"},
                    Damage{"d", "0.1 0 0 2\n0.1\n", "/d:1", "more bearings than the file has"},
                    Damage{"d", "0.1 0 0 1\nleft\n", "/d:2", "not a number"},
                    Damage{"lm.txt", "3\n1 2\n3 4\n", "/lm.txt:1", "another number of cones than the 2"},
                    Damage{"lm.txt", "1\n1\n", "/lm.txt:2", "1 column instead of 2"}));

TEST(CycloidData, HasItsFrames) {
  const std::string folder = std::string(FENCEPOST_SHARED_DIR) + "/data/world/cycloid";
  if (!std::filesystem::exists(folder)) {
    std::cerr << "\n*** SKIPPED: no cycloid data beside the checkout; nothing was compared ***\n";
    GTEST_SKIP() << "data/world/cycloid is not there";
  }
  const ImportResult result = import_cycloid(folder + "/194625.txt", folder + "/lm.txt");
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(result->summary.frames, 2'101U);
  EXPECT_EQ(result->truth->objects.size(), 8U);
}

}  // namespace
}  // namespace fencepost::host
