// The view of the perfect camera, worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "host/simulate/render.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

struct Render : testing::Test {
  Render() { scene.path = standing(0, 0, 0); }
  Scene scene = empty_scene();
};

TEST_F(Render, ABoxStraightAhead) {
  scene.objects = {box_object(1, 1.0, -0.1, 1.2, 0.1, 0.2)};
  // Front face at 1 m: columns 157.5 -+ 273.6 * 0.1 = 130.14..184.86, so pixel centres 131..184.
  // Rows 103.5 - 273.6 * (0.20 - 0.12) = 81.61 down to 103.5 + 273.6 * 0.12 = 136.33: 82..136.
  const sensor::Blob blob = only_blob(scene);
  expect_box(blob, 131, 82, 184, 136);
  EXPECT_EQ(blob.pixels, 54U * 55U);
  EXPECT_EQ(blob.cx.raw, 1575);  // (131 + 184) / 2
  EXPECT_EQ(blob.cy.raw, 1090);  // (82 + 136) / 2
  EXPECT_EQ(blob.signature, 1);
  ASSERT_TRUE(blob.rgb.has_value());
  EXPECT_EQ(*blob.rgb, (sensor::Rgb{0xd0, 0x20, 0x20}));
}

TEST_F(Render, TheLidOfALowBoxIsSeen) {
  scene.objects = {box_object(1, 1.0, -0.1, 1.2, 0.1, 0.05)};
  // The lid, 0.07 m below the camera, ends at 1.2 m: row 103.5 + 273.6 * 0.07 / 1.2 = 119.46, so 120.
  expect_box(only_blob(scene), 131, 120, 184, 136);
}

TEST_F(Render, TheUndersideOfSomethingThatHovers) {
  scene.objects = {box_object(1, 1.0, -0.1, 1.2, 0.1, 0.1, 0.2)};
  // Top at the front, (0.30 - 0.12) / 1: 103.5 - 49.25 = 54.25: 55. Underside's far edge, 0.08 / 1.2: 85.26: 85.
  expect_box(only_blob(scene), 131, 55, 184, 85);
}

TEST_F(Render, MountOffsetsAndYaw) {
  scene.camera.mount.x = base::Metres::nearest(0.1);
  scene.camera.mount.y = base::Metres::nearest(0.2);
  scene.camera.mount.yaw = base::Radians::nearest(1.5708);
  // Robot at (2, 3) heading -pi/2: camera at (2, 3) + R(-90 deg)(0.1, 0.2) = (2.2, 2.9), looking along +x.
  scene.path = standing(2, 3, -1.5708);
  scene.objects = {box_object(1, 3.2, 2.8, 3.4, 3.0, 0.2)};  // 1 m ahead, centred
  expect_box(only_blob(scene), 131, 82, 184, 136);
}

TEST_F(Render, LeftIsSmallU) {
  scene.objects = {box_object(1, 1.0, 0.1, 1.2, 0.2, 0.2)};
  EXPECT_LT(only_blob(scene).x2, 157);
}

TEST_F(Render, NothingBehindOrBesideIsSeen) {
  scene.objects = {box_object(1, -1.2, -0.1, -1.0, 0.1, 0.2), box_object(1, -0.1, 0.5, 0.1, 0.7, 0.2)};
  const Simulated simulated = run(scene);
  EXPECT_TRUE(simulated.log.frames.at(0).blobs.empty());
}

TEST_F(Render, AWallThatReachesBehindTheCameraFillsTheBorder) {
  scene.objects = {box_object(1, -1, 0.3, 2, 0.4, 0.5)};
  const sensor::Blob blob = only_blob(scene);
  EXPECT_EQ(blob.x1, 0);
  // Its far end, (2, 0.3): 157.5 - 273.6 * 0.15 = 116.46.
  EXPECT_EQ(blob.x2, 116);
}

TEST_F(Render, ANearPostCutsABoxInTwo) {
  scene.objects = {box_object(1, 1.0, -0.1, 1.2, 0.1, 0.2), box_object(2, 0.5, -0.01, 0.52, 0.01, 0.4)};
  const Simulated simulated = run(scene);
  const auto& blobs = simulated.log.frames.at(0).blobs;
  ASSERT_EQ(blobs.size(), 3U);
  // The post: 157.5 -+ 273.6 * 0.02 = 152.03..162.97: 153..162, rows 0..169.
  const auto& truth = simulated.truth[0].blobs;
  for (std::size_t i = 0; i < 3; ++i) {
    if (blobs[i].signature == 2) {
      expect_box(blobs[i], 153, 0, 162, 169);
      EXPECT_EQ(truth[i].left, BlobEnd::kEdge);
      EXPECT_EQ(truth[i].right, BlobEnd::kEdge);
      EXPECT_NEAR(truth[i].distance, 0.5, 1e-12);
    } else if (blobs[i].x1 == 131) {
      expect_box(blobs[i], 131, 82, 152, 136);
      EXPECT_EQ(truth[i].left, BlobEnd::kEdge);
      EXPECT_EQ(truth[i].right, BlobEnd::kOccluded);
    } else {
      expect_box(blobs[i], 163, 82, 184, 136);
      EXPECT_EQ(truth[i].left, BlobEnd::kOccluded);
      EXPECT_EQ(truth[i].right, BlobEnd::kEdge);
    }
  }
}

TEST_F(Render, ALowNearObjectLeavesTheTopOfATallFarOne) {
  scene.objects = {box_object(1, 1.0, -0.1, 1.2, 0.1, 0.2), box_object(2, 0.5, -0.2, 0.6, 0.2, 0.08)};
  const Simulated simulated = run(scene);
  const auto& blobs = simulated.log.frames.at(0).blobs;
  ASSERT_EQ(blobs.size(), 2U);
  const auto far = std::find_if(blobs.begin(), blobs.end(), [](const auto& b) { return b.signature == 1; });
  // The near lid's far edge: 103.5 + 273.6 * 0.04 / 0.6 = 121.74, so the far box is seen down to row 121.
  expect_box(*far, 131, 82, 184, 121);
  const auto index = static_cast<std::size_t>(far - blobs.begin());
  EXPECT_EQ(simulated.truth[0].blobs[index].left, BlobEnd::kEdge);
}

TEST_F(Render, LargestFirstAndLimited) {
  scene.max_blobs = 2;
  scene.objects = {box_object(1, 1.0, -0.3, 1.2, -0.2, 0.1), box_object(2, 1.0, -0.1, 1.2, 0.1, 0.2),
                   box_object(3, 1.0, 0.2, 1.2, 0.35, 0.1)};
  const Simulated simulated = run(scene);
  const auto& blobs = simulated.log.frames.at(0).blobs;
  ASSERT_EQ(blobs.size(), 2U);
  EXPECT_EQ(blobs[0].signature, 2);
  EXPECT_EQ(blobs[1].signature, 3);
  EXPECT_EQ(simulated.summary.blobs_dropped, 1U);
  EXPECT_EQ(simulated.summary.blobs, 2U);
}

TEST_F(Render, AnObjectBetweenTwoPixelCentresIsNotSeen) {
  // Columns 157 and 158 lie at -+0.5 px; 0.4 px to each side falls in between.
  const double half = 0.4 / 273.6;
  scene.objects = {box_object(1, 1.0, -half, 1.0001, half, 0.2)};
  EXPECT_TRUE(run(scene).log.frames.at(0).blobs.empty());
}

TEST_F(Render, SeesThroughAHoleFromAbove) {
  scene.camera.mount.z = base::Metres::nearest(1);
  SceneObject frame = box_object(1, 1.0, -0.5, 2.0, 0.5, 0.01);
  frame.footprint.holes.push_back({{1.2, -0.3}, {1.2, 0.3}, {1.8, 0.3}, {1.8, -0.3}});
  scene.objects = {frame, box_object(2, 1.5, -0.05, 1.6, 0.05, 0.01)};
  scene.camera.cy = base::Pixels2::nearest(-50);  // looks down by a shifted image, so level rules hold
  const Simulated simulated = run(scene);
  const auto& blobs = simulated.log.frames.at(0).blobs;
  EXPECT_TRUE(std::any_of(blobs.begin(), blobs.end(), [](const auto& b) { return b.signature == 2; }));
}

TEST_F(Render, BorderEndsAreToldInTheTruth) {
  scene.objects = {box_object(1, 1.0, 0.3, 1.2, 1.0, 0.2)};
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.truth.at(0).blobs.size(), 1U);
  EXPECT_EQ(simulated.truth[0].blobs[0].left, BlobEnd::kBorder);
  EXPECT_EQ(simulated.truth[0].blobs[0].right, BlobEnd::kEdge);
}

/// Processor time of ten images with `boxes` boxes, all of them to the left of what the camera sees.
double seconds_beside(int boxes) {
  Scene scene = empty_scene();
  for (int i = 0; i < boxes; ++i) scene.objects.push_back(box_object(1, 1.0, 5 + 0.02 * i, 1.01, 5.01 + 0.02 * i, 0.1));
  const PixelRays rays(scene.camera, 0);
  LabelImage image(scene.camera.width, scene.camera.height);
  image.render(scene.objects, rays, {});  // its memory is there from now on
  const std::clock_t start = std::clock();
  for (int i = 0; i < 10; ++i) image.render(scene.objects, rays, {});
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Each was compared with each: sixteen times the time for four times the objects.
TEST_F(Render, ObjectsOutOfViewCostTheirNumber) {
  EXPECT_LT(seconds_beside(8'000), 9 * std::max(seconds_beside(2'000), 0.01));
}

}  // namespace
}  // namespace fencepost::host
