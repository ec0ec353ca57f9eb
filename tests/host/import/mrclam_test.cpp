#include <gtest/gtest.h>

#include <filesystem>

#include <numbers>

#include "host/geometry/planar.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

constexpr double kPi = std::numbers::pi;

/// One robot, two landmarks, one other robot. The recording starts at 100 s.
void put_recording(const Files& files) {
  files.put("Barcodes.dat", "# comment\n  1 \t 5\n  2 \t 14\n  6 \t 63\n  7 \t 81\n");
  files.put("Landmark_Groundtruth.dat", "6 2.0 0.2 0.0001 0.0001\n7 2.0 -0.3 0.0001 0.0001\n");
  files.put("Robot2_Groundtruth.dat",
            "100.000 0 0 0\n101.000 0 0 0\n101.400 0.2 0 3.0\n101.6 0.4 0 -3.0\n102.000 1 0 -2\n");
  files.put("Robot2_Odometry.dat", "101.000 1.0 1.5707963267948966\n102.000 0.5 0\n104.000 0 0\n");
  files.put("Robot2_Measurement.dat",
            "101.200 63 2.000 0.100\n101.200 81 2.500 -0.200\n101.200 5 1.0 0.0\n101.300 99 1.0 0.0\n");
}

class ImportMrclam : public testing::Test {
 protected:
  ImportMrclam() { put_recording(files); }
  [[nodiscard]] ImportResult imported() const { return import_mrclam(files.folder(), options); }
  const Files files;
  MrclamOptions options;
};

TEST_F(ImportMrclam, TurnsRowsIntoTangentBoxes) {
  const ImportResult result = imported();
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 2U) << "rows with one time are one frame";
  EXPECT_EQ(log.frames[0].t.raw, 12'000) << "1.2 s after the earliest time in any file";
  ASSERT_EQ(log.frames[0].blobs.size(), 2U) << "the other robot is left out";
  const auto& near = log.frames[0].blobs[0];
  EXPECT_EQ(near.signature, 63) << "the barcode; wider, so first";
  // asin(0.06 / 2) = 0.0300045; edges at bearings 0.1300045 and 0.0699955:
  // 5999.5 - 8100 tan(0.1300045) = 4940.48 (x1 = round(4940.98)), 5999.5 - 8100 tan(0.0699955) = 5431.61 (x2 = 5431).
  EXPECT_EQ(near.x1, 4941);
  EXPECT_EQ(near.x2, 5431);
  EXPECT_EQ(near.pixels, 0U);
  EXPECT_FALSE(near.rgb.has_value());
  EXPECT_GE(near.y2, log.cameras[0].height - 2) << "no ground row";
  EXPECT_FALSE(log.cameras[0].mount.pitch.has_value());
  EXPECT_EQ(log.frames[0].blobs[1].signature, 81);
  EXPECT_TRUE(log.frames[1].blobs.empty());
  ASSERT_EQ(result->summary.skipped.size(), 2U);
  EXPECT_EQ(result->summary.skipped[0], (std::pair<std::string, std::uint64_t>{"rows that see another robot", 1}));
  EXPECT_EQ(result->summary.skipped[1], (std::pair<std::string, std::uint64_t>{"rows with an unknown barcode", 1}));
  ASSERT_EQ(log.signatures.size(), 2U);
  EXPECT_EQ(log.signatures[0].name.view(), "landmark 6");
}

TEST_F(ImportMrclam, TruePosesBecomeOdometryAndFramesFollowTheirPose) {
  const Recorded log = recorded(imported());
  ASSERT_EQ(log.odometry.size(), 5U);
  EXPECT_EQ(log.odometry[2].t.raw, 14'000);
  EXPECT_EQ(log.odometry[2].x.raw, 2'000);
  EXPECT_EQ(std::string(log.order.begin(), log.order.end()), "HCSSOOOFFOO");
}

TEST_F(ImportMrclam, TakesEachFilePackedOrNot) {
  const std::string plain = imported()->log;
  for (const char* name : {"Robot2_Measurement.dat", "Robot2_Groundtruth.dat", "Robot2_Odometry.dat", "Barcodes.dat",
                           "Landmark_Groundtruth.dat"}) {
    static_cast<void>(files.pack(name));
    const ImportResult packed = imported();
    ASSERT_TRUE(packed.ok()) << name << packed.error().message();
    EXPECT_EQ(packed->log, plain) << name;
  }
}

TEST_F(ImportMrclam, VelocitiesAreIntegratedByExactArcs) {
  options.poses = PoseSource::kOdometry;
  const Recorded log = recorded(imported());
  // From the truth at the first velocity (0, 0, 0): a quarter circle of radius 2/pi in 1 s. Then 2 s straight up at
  // 0.5 m/s.
  ASSERT_EQ(log.odometry.size(), 3U);
  EXPECT_EQ(log.odometry[0].t.raw, 10'000);
  EXPECT_EQ(log.odometry[0].x.raw, 0);
  EXPECT_NEAR(log.odometry[1].x.to_double(), 2 / kPi, 1e-4);
  EXPECT_NEAR(log.odometry[1].y.to_double(), 2 / kPi, 1e-4);
  EXPECT_NEAR(log.odometry[1].heading.to_double(), kPi / 2, 1e-4);
  EXPECT_NEAR(log.odometry[2].x.to_double(), 2 / kPi, 1e-4);
  EXPECT_NEAR(log.odometry[2].y.to_double(), 2 / kPi + 1, 1e-4);
}

TEST_F(ImportMrclam, AWindowStartsAtZeroFromTheTruePose) {
  options.poses = PoseSource::kOdometry;
  options.from = 1.1;
  options.to = 1.25;
  const Recorded log = recorded(imported());
  ASSERT_EQ(log.frames.size(), 1U);
  EXPECT_EQ(log.frames[0].t.raw, 1'000);
  EXPECT_EQ(log.odometry[0].t.raw, 0);
  EXPECT_EQ(log.odometry[0].x.raw, 500) << "truth at 101.1 s: a quarter of the way to 0.2";
  EXPECT_EQ(log.odometry[0].heading.raw, 7'500);
  EXPECT_GT(log.odometry.back().t, log.frames[0].t) << "one sample past the end";
  options.poses = PoseSource::kTruth;
  const Recorded truth = recorded(imported());
  EXPECT_EQ(truth.frames.size(), 1U);
}

TEST_F(ImportMrclam, OtherRobotsOnRequest) {
  options.include_robots = true;
  const Recorded log = recorded(imported());
  EXPECT_EQ(log.frames[0].blobs.size(), 3U);
  EXPECT_EQ(log.signatures.size(), 4U);
}

TEST_F(ImportMrclam, RobotsAlikeAreOneSignature) {
  options.include_robots = options.robots_alike = true;
  const Recorded log = recorded(imported());
  ASSERT_EQ(log.signatures.size(), 3U);
  EXPECT_EQ(log.signatures[0].name.view(), "robot");
  ASSERT_EQ(log.frames[0].blobs.size(), 3U);
  EXPECT_EQ(log.frames[0].blobs[0].signature, 1) << "the robot, nearest";
  EXPECT_EQ(log.frames[0].blobs[1].signature, 6) << "the landmark's subject";
}

TEST_F(ImportMrclam, RangesBecomeGroundRowsOnRequest) {
  options.rows = true;
  const Recorded log = recorded(imported());
  EXPECT_EQ(log.cameras[0].mount.z.raw, 3'000);
  ASSERT_TRUE(log.cameras[0].mount.pitch.has_value());
  // The nearest point in depth: 2 cos(0.1) - 0.06 = 1.93001 m; 3599.5 + 8100 * 0.3 / 1.93001 - 0.5 = 4858.06.
  EXPECT_EQ(log.frames[0].blobs[0].y2, 4858);
}

TEST_F(ImportMrclam, WithoutTruePosesOdometryStartsAtZero) {
  files.remove("Robot2_Groundtruth.dat");
  EXPECT_FALSE(imported().ok());
  options.poses = PoseSource::kOdometry;
  const Recorded log = recorded(imported());
  EXPECT_EQ(log.odometry[0].t.raw, 0) << "the earliest time is that of the odometry now";
  EXPECT_EQ(log.odometry[0].x.raw, 0);
  EXPECT_NEAR(log.odometry[1].x.to_double(), 2 / kPi, 1e-4);
}

TEST_F(ImportMrclam, BarcodesBeyond255FallBackToSubjects) {
  files.put("Barcodes.dat", "2 14\n6 630\n7 81\n");
  files.put("Robot2_Measurement.dat", "101.200 630 2.000 0.100\n");
  const ImportResult result = imported();
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(read_back(result->log).frames[0].blobs[0].signature, 6);
  EXPECT_EQ(result->summary.notes.size(), 3U);
}

TEST_F(ImportMrclam, TruthIsAReadableSceneOfCircles) {
  options.diameter = 0.1;
  const ImportResult result = imported();
  ASSERT_TRUE(result->truth.has_value());
  const LoadedScene scene = parse_scene(write_scene(*result->truth), "truth");
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  ASSERT_EQ(scene->objects.size(), 2U);
  EXPECT_EQ(scene->objects[0].signature, 63);
  EXPECT_NEAR(area(scene->objects[0].footprint), kPi * 0.0025, 1e-9);
  EXPECT_NEAR(scene->objects[0].footprint.outer[0].x, 2.05, 1e-5);
}

class DamagedMrclam : public testing::TestWithParam<Damage> {};

TEST_P(DamagedMrclam, IsRefusedWithFileAndLine) {
  const Files files;
  put_recording(files);
  files.put(GetParam().file, GetParam().text);
  expect_refused(import_mrclam(files.folder(), {}), files, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Files, DamagedMrclam,
    testing::Values(Damage{"Robot2_Odometry.dat", "# c\n1 2\n", "/Robot2_Odometry.dat:2", "2 columns instead of 3"},
                    Damage{"Robot2_Odometry.dat", "1 2 x\n", "/Robot2_Odometry.dat:1", "\"x\" is not a number"},
                    Damage{"Robot2_Odometry.dat", "# only\n", "/Robot2_Odometry.dat", "no rows"},
                    Damage{"Robot2_Groundtruth.dat", "2 0 0 0\n1 0 0 0\n", "/Robot2_Groundtruth.dat:2", "backwards"},
                    Damage{"Robot2_Measurement.dat", "2 63 1 0\n1 63 1 0\n", "/Robot2_Measurement.dat:2", "backwards"},
                    Damage{"Robot2_Measurement.dat", "2 6.5 1 0\n", "/Robot2_Measurement.dat:1", "whole number"},
                    Damage{"Barcodes.dat", "6 63\n7 63\n", "/Barcodes.dat:2", "twice"},
                    Damage{"Barcodes.dat", "6 630\n262 63\n", "/Barcodes.dat", "subject 262 and barcode 630"},
                    Damage{"Robot3_Measurement.dat", "2 63 1 0\n", "", "several robots"}));

TEST_F(ImportMrclam, RefusesMissingFilesAndBadOptions) {
  const auto error_of = [&](auto change) {
    options = {};
    change(options);
    const ImportResult result = imported();
    return result.ok() ? std::string("accepted") : result.error().where;
  };
  EXPECT_EQ(error_of([](MrclamOptions& o) { o.diameter = 0; }), "--diameter");
  EXPECT_EQ(error_of([](MrclamOptions& o) { o.from = -1; }), "--from");
  EXPECT_EQ(error_of([](MrclamOptions& o) { o.to = 0; }), "--to");
  EXPECT_EQ(error_of([](MrclamOptions& o) { o.from = 500; }), "the window");
  EXPECT_EQ(error_of([](MrclamOptions& o) { o.robot = 4; }), files.folder());
  options = {};
  files.remove("Barcodes.dat");
  EXPECT_EQ(imported().error().where, files.folder() + "/Barcodes.dat");
  files.remove("Robot2_Measurement.dat");
  EXPECT_NE(imported().error().what.find("no RobotN_Measurement.dat"), std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
