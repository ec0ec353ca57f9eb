#include <gtest/gtest.h>

#include <filesystem>
#include <iostream>
#include <numbers>

#include "host/geometry/planar.hpp"
#include "host/import/import.hpp"
#include "host/scene/load.hpp"
#include "tests/host/import/files.hpp"

namespace fencepost::host {
namespace {

constexpr const char* kCalibration =
    "P0: 721.5377 0 609.5593 0 0 721.5377 172.854 0 0 0 1 0\n"
    "P2: 721.5377 0 609.5593 0 0 721.5377 172.854 0 0 0 1 0\n";

/// `frame track kind occluded box place`; 1.5 m high, 1.6 m wide, 4 m long.
std::string label(int frame, int track, const char* kind, int occluded, const char* box, double right, double ahead,
                  double yaw) {
  return std::to_string(frame) + " " + std::to_string(track) + " " + kind + " 0 " + std::to_string(occluded) + " 0 " +
         box + " 1.5 1.6 4.0 " + std::to_string(right) + " 1.65 " + std::to_string(ahead) + " " + std::to_string(yaw) +
         "\n";
}

/// Ten frames straight ahead, 1 m each. Car 4 is parked 20 m ahead and 3 m to the right. Van 7 drives
/// 10 m ahead. Cyclist 9 is there once.
void put_drive(const Files& files) {
  std::string poses;
  std::string labels;
  for (int i = 0; i < 10; ++i) {
    poses += "1 0 0 0 0 1 0 0 0 0 1 " + std::to_string(i) + "\n";
    labels += std::to_string(i) + " -1 DontCare -1 -1 -10 1 1 2 2 -1000 -1000 -1000 -10 -1 -1 -1\n";
    labels += label(i, 4, "Car", 0, "700.4 180 760.6 220.5", 3, 20 - i, -std::numbers::pi / 2);
    labels += label(i, 7, "Van", i == 3 ? 2 : 1, "580 175 640 240", 0, 10, -std::numbers::pi / 2);
  }
  labels += label(2, 9, "Cyclist", 0, "100 100 120 150", -5, 10, 0);
  files.put("calib.txt", kCalibration);
  files.put("poses.txt", poses);
  files.put("labels.txt", labels);
}

class ImportKitti : public testing::Test {
 protected:
  ImportKitti() { put_drive(files); }
  [[nodiscard]] ImportResult imported(const KittiOptions& options = {}) const {
    return import_kitti(files.folder(), options);
  }
  const Files files;
};

TEST_F(ImportKitti, ADriveIsScaledAndItsCarsAreOneSignature) {
  const ImportResult result = imported();
  const Recorded log = recorded(result);
  ASSERT_EQ(log.frames.size(), 10U);
  ASSERT_EQ(log.odometry.size(), 10U);
  EXPECT_EQ(log.odometry[9].x.raw, 9'000) << "9 m at a tenth, in 0.1 mm";
  EXPECT_EQ(log.frames[9].t.raw, 9'000);
  ASSERT_EQ(log.frames[0].blobs.size(), 2U);
  const auto& van = log.frames[0].blobs[0];
  EXPECT_EQ(van.x1, 580) << "largest first";
  const auto& car = log.frames[0].blobs[1];
  EXPECT_EQ(car.signature, 1);
  EXPECT_EQ(car.track, 0) << "without --ids";
  EXPECT_EQ(car.x1, 700);
  EXPECT_EQ(car.x2, 761);
  EXPECT_EQ(car.y2, 221);
  EXPECT_EQ(log.frames[3].blobs.size(), 1U) << "the van is largely hidden";
  EXPECT_EQ(log.cameras[0].width, 1242);
  EXPECT_EQ(log.cameras[0].mount.z.raw, 1'650);
  EXPECT_FALSE(log.cameras[0].mount.pitch.has_value());
  ASSERT_EQ(log.signatures.size(), 1U);
  ASSERT_EQ(result->summary.skipped.size(), 2U);
  EXPECT_EQ(result->summary.skipped[0],
            (std::pair<std::string, std::uint64_t>{"labels of cars that are largely hidden", 1}));
  EXPECT_EQ(result->summary.skipped[1], (std::pair<std::string, std::uint64_t>{"labels of other things than cars", 1}));
}

TEST_F(ImportKitti, IdentityIsASignatureForEachTrack) {
  KittiOptions options;
  options.identity = true;
  options.pitch = -0.0175;
  options.scale = 0.5;
  const Recorded log = recorded(imported(options));
  ASSERT_EQ(log.signatures.size(), 2U);
  EXPECT_EQ(log.signatures[0].name.view(), "Car 4");
  EXPECT_EQ(log.signatures[1].name.view(), "Van 7");
  EXPECT_EQ(log.frames[0].blobs[0].signature, 2);
  EXPECT_EQ(log.cameras[0].mount.pitch->raw, -175);
  EXPECT_EQ(log.cameras[0].mount.z.raw, 8'250);
  EXPECT_EQ(log.odometry[9].x.raw, 45'000);
}

TEST_F(ImportKitti, IdsAreThoseOfTheTracks) {
  KittiOptions options;
  options.ids = true;
  const Recorded log = recorded(imported(options));
  ASSERT_EQ(log.frames.size(), 10U);
  for (const auto& frame : log.frames) {
    for (const sensor::Blob& blob : frame.blobs) EXPECT_EQ(blob.track, blob.x1 == 580 ? 8 : 5);
  }
}

TEST_F(ImportKitti, TruthIsWhatIsParked) {
  const ImportResult result = imported();
  ASSERT_TRUE(result.ok()) << result.error().message();
  ASSERT_TRUE(result->truth.has_value());
  const LoadedScene scene = parse_scene(write_scene(*result->truth), "truth");
  ASSERT_TRUE(scene.ok()) << scene.error().message();
  ASSERT_EQ(scene->objects.size(), 1U) << "the van drives 9 m";
  const SceneObject& car = scene->objects[0];
  EXPECT_EQ(car.name, "Car 4");
  EXPECT_NEAR(car.height_m, 0.15, 1e-9);
  // 20 m ahead and 3 m to the right at a tenth: x 1.8 to 2.2, y -0.38 to -0.22.
  const MultiPolygon expected = {{{{1.8, -0.38}, {2.2, -0.38}, {2.2, -0.22}, {1.8, -0.22}}, {}}};
  EXPECT_NEAR(intersection_area({car.footprint}, expected), 0.064, 1e-6);
  EXPECT_NEAR(union_area({car.footprint}, expected), 0.064, 1e-6);
}

TEST_F(ImportKitti, PlacesAreTakenThroughThePoseAndTheCamerasOffset) {
  // The camera looks along the world's -x, that is to our left (y), from x 0, z 2; labels are 0.5 m right of it.
  files.put("calib.txt", "P2: 721.5377 0 609.5593 360.76885 0 721.5377 172.854 0 0 0 1 0\n");
  std::string poses;
  std::string labels;
  for (int i = 0; i < 8; ++i) {
    poses += "0 0 -1 0 0 1 0 0 1 0 0 2\n";
    labels += label(i, 0, "Car", 0, "600 180 620 200", 0.5, 10, 0);
  }
  files.put("poses.txt", poses);
  files.put("labels.txt", labels);
  const ImportResult result = import_kitti(files.folder(), {});
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_NEAR(read_back(result->log).odometry[0].heading.to_double(), std::numbers::pi / 2, 1e-4);
  ASSERT_EQ(result->truth->objects.size(), 1U);
  // 10 m to the left, 1 m right of that is ahead: (2 + 1, 10); its length (yaw 0) is along the image, our x.
  const MultiPolygon expected = {{{{0.1, 0.92}, {0.5, 0.92}, {0.5, 1.08}, {0.1, 1.08}}, {}}};
  EXPECT_NEAR(intersection_area({result->truth->objects[0].footprint}, expected), 0.064, 1e-6);
}

TEST_F(ImportKitti, OneCarWithTwoTracksIsOneObject) {
  std::string labels;
  for (int i = 0; i < 10; ++i) {
    labels += label(i, 1, "Car", 0, "600 180 620 200", 3, 20 - i, 0);
    labels += label(i, 2, "Car", 0, "600 180 620 200", 4.5, 20 - i, 0);
    labels += label(i, 3, "Car", 0, "600 180 620 200", 5, 20 - i, 0);
  }
  files.put("labels.txt", labels);
  const ImportResult result = imported();
  ASSERT_TRUE(result.ok()) << result.error().message();
  ASSERT_EQ(result->truth->objects.size(), 2U) << "1.5 m is one car, 2 m are two";
  EXPECT_EQ(result->truth->objects[1].name, "Car 3");
}

TEST_F(ImportKitti, ADetectorsBoxesTakeTheLabelsPlace) {
  KittiOptions options;
  options.detections = files.put("found.txt", "0,100.4,170,150.2,200,0.9\n3,1230,170,1243,376,0.5\n99,1,1,2,2,0.1\n");
  const ImportResult result = imported(options);
  const Recorded log = recorded(result);
  EXPECT_EQ(result->summary.blobs, 2U);
  EXPECT_EQ(log.frames[0].blobs[0].x2, 150);
  EXPECT_EQ(log.frames[3].blobs[0].x2, 1241) << "clamped to the image";
  EXPECT_EQ(log.frames[3].blobs[0].y2, 374);
  EXPECT_EQ(result->truth->objects.size(), 1U) << "of the labels";
}

TEST_F(ImportKitti, LabelsWithoutAPoseAreCounted) {
  files.put("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const ImportResult result = imported();
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(result->summary.frames, 1U);
  EXPECT_EQ(result->summary.skipped[0], (std::pair<std::string, std::uint64_t>{"frames without a pose", 9}));
  EXPECT_TRUE(result->truth->objects.empty());
}

class DamagedKitti : public testing::TestWithParam<Damage> {};

TEST_P(DamagedKitti, IsRefusedWithFileAndLine) {
  const Files files;
  put_drive(files);
  files.put(GetParam().file, GetParam().text);
  expect_refused(import_kitti(files.folder(), {}), files, GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Files, DamagedKitti,
    testing::Values(Damage{"calib.txt", "P1: 1 2\n", "/calib.txt", "no line P2"},
                    Damage{"calib.txt", "P1: 1 2\nP2: 721.5 0 609\n", "/calib.txt:2", "4 columns instead of 13"},
                    Damage{"calib.txt", "P2: 500 0 609 0 0 500 172 0 0 0 1 0\n", "/calib.txt:1", "focal length"},
                    Damage{"poses.txt", "1 0 0 0 0 1 0 0 0 0 1\n", "/poses.txt:1", "11 columns instead of 12"},
                    Damage{"labels.txt", "0 1 Car 0 0\n", "/labels.txt:1", "5 columns instead of 17"},
                    Damage{"labels.txt", "x 1 Car 0 0 0 1 1 2 2 1 1 1 1 1 1 1\n", "/labels.txt:1", "not a number"},
                    Damage{"labels.txt", "0.5 1 Car 0 0 0 1 1 2 2 1 1 1 1 1 1 1\n", "/labels.txt:1", "whole number"},
                    Damage{"labels.txt", "-1 1 Car 0 0 0 1 1 2 2 1 1 1 1 1 1 1\n", "/labels.txt:1", "negative frame"},
                    Damage{"labels.txt", "", "/labels.txt", "is empty"}));

TEST_F(ImportKitti, RefusesMissingFilesAndBadOptions) {
  const auto error_of = [&](auto change) {
    KittiOptions options;
    change(options);
    const ImportResult result = imported(options);
    return result.ok() ? std::string("accepted") : result.error().where;
  };
  EXPECT_EQ(error_of([](KittiOptions& o) { o.scale = 0; }), "--scale");
  EXPECT_EQ(error_of([](KittiOptions& o) { o.scale = 2; }), "--scale");
  EXPECT_EQ(error_of([&](KittiOptions& o) { o.detections = files.folder() + "/none"; }), files.folder() + "/none");
  EXPECT_EQ(error_of([&](KittiOptions& o) {
              o.detections = files.folder() + "/labels.txt";
              o.identity = true;
            }),
            "--identity");
  EXPECT_EQ(error_of([&](KittiOptions& o) {
              o.detections = files.folder() + "/labels.txt";
              o.ids = true;
            }),
            "--ids");
  files.remove("calib.txt");
  EXPECT_EQ(imported().error().where, files.folder() + "/calib.txt");
}

TEST(KittiData, HasParkedCars) {
  const std::string folder = std::string(FENCEPOST_SHARED_DIR) + "/data/world/kitti/0001";
  if (!std::filesystem::exists(folder)) {
    std::cerr << "\n*** SKIPPED: no KITTI data beside the checkout; nothing was compared ***\n";
    GTEST_SKIP() << "data/world/kitti is not there";
  }
  const ImportResult result = import_kitti(folder, {});
  ASSERT_TRUE(result.ok()) << result.error().message();
  EXPECT_EQ(result->summary.frames, 447U);
  EXPECT_EQ(result->truth->objects.size(), 74U);
}

}  // namespace
}  // namespace fencepost::host
