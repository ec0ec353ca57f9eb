// Objects that move, come and go, and what the camera was not taught; somebody else at the wheel.
#include "host/simulate/world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"
#include "host/simulate/trajectory.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

constexpr double kHalfTurn = std::numbers::pi;

TEST(World, AnObjectMovesWithThePointOfItsPath) {
  SceneObject box = box_object(1, 1, -0.1, 1.2, 0.1, 0.2);
  box.path = {{2, 1, 0, 0}, {4, 3, 0, kHalfTurn / 2}};
  // Before its first pose it stands where it was drawn.
  EXPECT_EQ(footprint_at(box, 0).outer[0].x, 1);
  EXPECT_EQ(footprint_at(box, 2).outer[0].y, -0.1);
  // At the end the point (1, 0) is at (3, 0) and the box is turned by 90 degrees. (1, -0.1) is 0.1 to its right, so it
  // comes to (3.1, 0); (1.2, -0.1) comes to (3.1, 0.2).
  for (const double t : {4.0, 9.0}) {
    const LinearRing ring = footprint_at(box, t).outer;
    EXPECT_NEAR(ring[0].x, 3.1, 1e-12);
    EXPECT_NEAR(ring[0].y, 0, 1e-12);
    EXPECT_NEAR(ring[1].x, 3.1, 1e-12);
    EXPECT_NEAR(ring[1].y, 0.2, 1e-12);
  }
  EXPECT_NEAR(signed_area(footprint_at(box, 3).outer), 0.04, 1e-12);
}

TEST(World, HeadingsTurnTheShortWay) {
  SceneObject box = box_object(1, 0, 0, 1, 1, 0.2);
  box.path = {{0, 0, 0, 3}, {1, 0, 0, -3}};
  // From 3 to -3 rad the short way is 0.283 rad on to the left: half of it at 0.5 s.
  EXPECT_NEAR(footprint_at(box, 0.5).outer[1].y, std::sin(kHalfTurn - 3), 1e-12);
}

TEST(World, AStillSceneIsNotCopied) {
  Scene scene = empty_scene();
  scene.objects = {box_object(1, 1, -0.1, 1.2, 0.1, 0.2)};
  World world(scene);
  EXPECT_EQ(&world.at(5), &scene.objects);
}

TEST(World, ARollingBoxIsSeenWhereItIsAtTheExposure) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0, 2, 1);
  scene.rate = 1;
  scene.camera.latency = base::Duration::nearest(0.4);
  scene.objects = {box_object(1, 3, -0.1, 3.2, 0.1, 0.2)};
  scene.objects[0].path = {{0, 3, 0, 0}, {1, 1, 0, 0}};
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.log.frames.size(), 2U);
  // At 1 s its front is 1 m ahead: 157.5 -+ 27.36, as a box that stands there is seen.
  const sensor::Blob& blob = simulated.log.frames[1].blobs[0];
  EXPECT_EQ(blob.x1, 131);
  EXPECT_EQ(blob.x2, 184);
  EXPECT_EQ(blob.y2, 136);
  EXPECT_NEAR(simulated.truth[1].blobs[0].distance, 1, 1e-9);
}

TEST(World, AnObjectIsThereFromItsTimeUntilTheOther) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0, 5, 10);
  scene.rate = 10;
  scene.objects = {box_object(2, 1, 0.5, 1.2, 0.7, 0.2), box_object(1, 1, -0.1, 1.2, 0.1, 0.2)};
  scene.objects[1].from = 0.1;
  scene.objects[1].until = 0.3;
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.log.frames.size(), 5U);
  for (const std::size_t frame : {0U, 3U, 4U}) EXPECT_EQ(simulated.log.frames[frame].blobs.size(), 1U) << frame;
  for (const std::size_t frame : {1U, 2U}) {
    ASSERT_EQ(simulated.log.frames[frame].blobs.size(), 2U) << frame;
    EXPECT_EQ(simulated.truth[frame].blobs[0].object, 1U) << "numbers are the scene's";
  }
}

TEST(World, ComingAndGoingLeavesTheOthersDrawsAlone) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0, 20);
  scene.noise.edge_px = 2;
  scene.objects = {box_object(1, 1, -0.4, 1.2, -0.2, 0.2), box_object(2, 1, 0.2, 1.2, 0.4, 0.2)};
  const Simulated both = run(scene);
  scene.objects[0].until = 0.1;
  const Simulated one = run(scene);
  for (std::size_t i = 0; i < both.truth.size(); ++i) {
    for (std::size_t b = 0; b < one.truth[i].blobs.size(); ++b) {
      if (one.truth[i].blobs[b].object != 1U) continue;
      const std::size_t same = both.truth[i].blobs[0].object == 1U ? 0 : 1;
      EXPECT_EQ(one.truth[i].frame.blobs[b], both.truth[i].frame.blobs[same]);
    }
  }
}

TEST(World, WhatIsNotTrainedHidesAndIsNotReported) {
  Scene scene = empty_scene();
  scene.path = standing(0, 0, 0);
  scene.objects = {box_object(1, 1, -0.1, 1.2, 0.1, 0.2), box_object(0, 0.9, -0.1, 0.95, 0, 0.2)};
  scene.objects[1].trained = false;
  const Simulated simulated = run(scene);
  ASSERT_EQ(simulated.log.frames[0].blobs.size(), 1U);
  // The grey box covers the columns from 157.5 to 157.5 + 273.6 * 0.1 / 0.9 = 187.9: the right half of the other.
  EXPECT_EQ(simulated.log.frames[0].blobs[0].x1, 131);
  EXPECT_EQ(simulated.log.frames[0].blobs[0].x2, 157);
  EXPECT_EQ(simulated.truth[0].blobs[0].right, BlobEnd::kOccluded);
}

TEST(Driven, ADriverOnThePathGivesThePathsBytes) {
  Scene scene = empty_scene();
  scene.objects = {box_object(1, 1.5, -0.1, 1.7, 0.1, 0.2)};
  scene.noise.edge_px = 1;
  scene.noise.pose_xy = 0.004;
  scene.path = PosesPath{{{0, 0, 0, 0}, {2, 1, 0.2, 0.3}}};
  const Trajectory trajectory(scene);
  std::string driven;
  double next = 0;  // s, of the sample of odometry that is due
  double ahead = 0;
  const auto sink = [&](std::string_view line) {
    driven += line;
    if (line.starts_with("$FPODO,")) next += 0.02;
  };
  const auto pose = [&](double t) {
    ahead = std::max(ahead, t - next);
    return trajectory.at(t);
  };
  ASSERT_TRUE(simulate_driven(scene, {pose, {}, 2}, sink, {}).ok());
  EXPECT_EQ(driven, run(scene).log.text);
  EXPECT_LT(ahead, 1e-6) << "a driver cannot know what comes";
}

TEST(Driven, EndsWhenToldSo) {
  Scene scene = empty_scene();
  const auto pose = [](double t) { return TimedPose{t, 0.1 * t, 0, 0}; };
  std::string text;
  const auto sink = [&](std::string_view line) { text += line; };
  const auto summary = simulate_driven(scene, {pose, [](double t) { return t >= 1; }, 10}, sink, {});
  ASSERT_TRUE(summary.ok());
  EXPECT_EQ(summary->odometry, 50U);
  EXPECT_EQ(read_back(text).frames.back().t.raw, 9800);
}

}  // namespace
}  // namespace fencepost::host
