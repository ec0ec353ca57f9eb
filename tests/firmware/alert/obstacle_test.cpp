#include "firmware/alert/obstacle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware/alert/box_outline.hpp"
#include "tests/firmware/alert/known_object.hpp"

namespace fencepost::test {
namespace {

using alert::Obstacle;
using alert::RobotPath;

alert::Obstacle see_obstacle(const recon::ObjectCore& object, const recon::MapPose& pose, const RobotPath& path) {
  return alert::see_obstacle(object, alert::RobotPlace(pose), alert::SweptByBody(path));
}

RobotPath driving(float forward, float turn = 0) {
  RobotPath path;
  path.motion = {forward, turn};
  path.half_width = 0.15F;
  path.body_radius = 0.10F;
  return path;
}

TEST(Obstacle, DistanceAndBearingAreFromTheRobotsOriginToTheNearestPoint) {
  // Robot at (1, 2) facing +y; object of radius 0.1 at (0.7, 2.4): 0.4 ahead, 0.3 left, 0.5 away.
  const auto object = known_object(0.7, 2.4, 0.1);
  const Obstacle seen = see_obstacle(object, {{100'000, 200'000}, 1'570'796}, driving(0));
  ASSERT_TRUE(seen.known);
  EXPECT_NEAR(seen.distance, 0.4F, 2e-3F);
  EXPECT_NEAR(seen.bearing(), 0.6435F, 5e-3F);  // atan2(0.3, 0.4)
  EXPECT_FALSE(seen.closing);
}

constexpr float kDepth = 0.1F;  // of the boxes below
constexpr float kWidth = 0.3F;

recon::PlacedOutline placed(const BoxOutline& box, recon::MapPoint at) {
  return {box.view(), at, box.view().known_well()};
}

// 1 m away, so its front is at 0.95 m; the cylinder's is at 0.9 m.
TEST(Obstacle, DistanceIsToTheOutlineWhereThatIsKnownWell) {
  const alert::RobotPlace robot({{0, 0}, 0});
  const Obstacle cylinder = alert::see_obstacle(known_object(1.0, 0, 0.1), robot, alert::SweptByBody(driving(0.2F)));
  const BoxOutline box(kDepth, kWidth, 0.004F);
  Obstacle seen = cylinder;
  alert::measure_by_outline(placed(box, {100'000, 0}), robot, alert::SweptByBody(driving(0.2F)), seen);
  EXPECT_NEAR(seen.distance, 0.95F, 1e-3F);
  ASSERT_TRUE(seen.in_path);
  EXPECT_NEAR(seen.in_path->sigma, 0.004F, 2e-4F);
  EXPECT_NEAR(seen.ttc, (0.95F - 0.1F) / 0.2F, 0.02F);
  const BoxOutline unsure(kDepth, kWidth, 0.06F);  // its mean support value is 0.13 m
  seen = cylinder;
  alert::measure_by_outline(placed(unsure, {100'000, 0}), robot, alert::SweptByBody(driving(0.2F)), seen);
  EXPECT_EQ(seen.distance, cylinder.distance);
  EXPECT_EQ(seen.ttc, cylinder.ttc);
}

TEST(Obstacle, AnOutlineBesideThePathTakesNoneIntoIt) {
  const alert::RobotPlace robot({{0, 0}, 0});
  const BoxOutline box(kDepth, kWidth, 0.004F);
  Obstacle seen = alert::see_obstacle(known_object(1.0, 0.5, 0.1), robot, alert::SweptByBody(driving(0.2F)));
  alert::measure_by_outline(placed(box, {100'000, 50'000}), robot, alert::SweptByBody(driving(0.2F)), seen);
  EXPECT_NEAR(seen.distance, std::hypot(0.95F, 0.35F), 2e-3F);  // to its nearest corner
  EXPECT_FALSE(seen.in_path);
}

// The circle around a long thing reaches into the path from either side; the thing does so only across it.
TEST(Obstacle, ALongOutlineIsInThePathWhereItIs) {
  const alert::RobotPlace robot({{0, 0}, 0});
  const alert::SweptByBody swept(driving(0.2F));
  const auto in_path = [&](const BoxOutline& box, std::int32_t y) {
    Obstacle seen = alert::see_obstacle(known_object(1.0, 1e-5 * y, 0.6), robot, swept);
    EXPECT_TRUE(seen.in_path);
    alert::measure_by_outline(placed(box, {100'000, y}), robot, swept, seen);
    return seen.in_path.has_value();
  };
  const BoxOutline along(1.0F, kDepth, 0.004F);
  EXPECT_FALSE(in_path(along, 25'000));
  EXPECT_FALSE(in_path(along, -25'000));
  EXPECT_TRUE(in_path(along, 15'000));
  const BoxOutline across(kDepth, 1.0F, 0.004F);  // no corner of it is in the path
  EXPECT_TRUE(in_path(across, 0));
  EXPECT_TRUE(in_path(across, -60'000));
  EXPECT_FALSE(in_path(across, -70'000));
}

// Rows say that it comes by itself, or stands on a base. Beside the body, within the margin, it is no obstacle.
TEST(Obstacle, TheMarginIsNotForWhatRowsPutFarther) {
  const auto seen_at = [](double aside, bool rows) {
    recon::ObjectCore object = known_object(1.0, aside, 0.1);
    for (int i = 0; rows && i < 10; ++i) {
      recon::Sighting sighting = view_of_circle({1.0, aside}, 0.1, {0.01 * i, 0}).sighting;
      sighting.axis = {1, 0};
      sighting.rows_known = true;
      sighting.bottom = {sighting.lens_height / 1.8F, recon::End::kSeen};  // twice as far
      object.cylinder.add(sighting, object.origin, 1, {});
      object.cylinder.solve(sighting.lens_from(object.origin), sighting.center, {});
    }
    return see_obstacle(object, {{10'000, 0}, 0}, driving(0.2F)).in_path.has_value();
  };
  EXPECT_TRUE(seen_at(0.22, false));
  EXPECT_FALSE(seen_at(0.22, true));
  EXPECT_TRUE(seen_at(0.18, true)) << "the body touches it";
}

TEST(Obstacle, InsideTheObjectTheDistanceIsZero) {
  EXPECT_EQ(see_obstacle(known_object(1.0, 0, 0.1), {{97'000, 0}, 0}, driving(0)).distance, 0);
}

TEST(Obstacle, TimeToContactIsUntilTheBodyTouches) {
  const Obstacle ahead = see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 0}, driving(0.2F));
  ASSERT_TRUE(ahead.closing);
  EXPECT_NEAR(ahead.ttc, (0.9F - 0.1F) / 0.2F, 0.02F);
  EXPECT_FALSE(see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 0}, driving(-0.2F)).closing);
  EXPECT_FALSE(see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 1'570'796}, driving(0.2F)).closing);  // beside
}

TEST(Obstacle, TheStraightPathIsAsWideAsTheRobotAndItsMargin) {
  for (const double y : {0.0, 0.24, -0.24}) {
    EXPECT_TRUE(see_obstacle(known_object(1.0, y, 0.1), {{0, 0}, 0}, driving(0.2F)).in_path) << y;
  }
  for (const double y : {0.26, -0.26}) {
    EXPECT_FALSE(see_obstacle(known_object(1.0, y, 0.1), {{0, 0}, 0}, driving(0.2F)).in_path) << y;
  }
  EXPECT_TRUE(see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 0}, driving(0)).in_path);  // standing: straight ahead
  EXPECT_FALSE(see_obstacle(known_object(1.0, 0, 0.1), {{200'000, 0}, 0}, driving(0.2F)).in_path);  // behind
  EXPECT_TRUE(see_obstacle(known_object(1.0, 0, 0.1), {{200'000, 0}, 0}, driving(-0.2F)).in_path);  // reversing
}

TEST(Obstacle, WhatIsPassedIsNoLongerInThePath) {
  // Beside the robot, its far half still ahead of the axle: the gap is 0.1 m, but nothing comes nearer any more.
  const auto object = known_object(1.0, 0.2, 0.1);
  EXPECT_TRUE(see_obstacle(object, {{95'000, 0}, 0}, driving(0.2F)).in_path);
  EXPECT_FALSE(see_obstacle(object, {{105'000, 0}, 0}, driving(0.2F)).in_path);
}

TEST(Obstacle, SaysHowWellItKnows) {
  auto object = known_object(1.0, 0, 0.1);
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  const Obstacle seen = see_obstacle(object, {{0, 0}, 0}, driving(0.2F));
  // The nearest point is the centre less the radius along x: var = xx - 2 xr + rr.
  const float variance = cylinder.covariance.xx - 2 * cylinder.covariance.xr + cylinder.covariance.rr;
  ASSERT_TRUE(seen.in_path);
  EXPECT_NEAR(seen.in_path->sigma, std::sqrt(variance), 1e-4F);
  EXPECT_GT(seen.in_path->sigma, 0);
  EXPECT_NEAR(seen.closing_speed, 0.2F, 1e-4F);
  EXPECT_FALSE(seen.cut_off);
  object.right = recon::End::kLowerBound;
  EXPECT_TRUE(see_obstacle(object, {{0, 0}, 0}, driving(0.2F)).cut_off);
}

TEST(Obstacle, ACurvedPathFollowsTheArc) {
  // Turning left on a circle of 1 m around (0, 1): it passes (0.707, 0.293) and misses (1.2, 0).
  EXPECT_TRUE(see_obstacle(known_object(0.707, 0.293, 0.05), {{0, 0}, 0}, driving(0.2F, 0.2F)).in_path);
  EXPECT_FALSE(see_obstacle(known_object(1.2, 0.0, 0.05), {{0, 0}, 0}, driving(0.2F, 0.2F)).in_path);
  EXPECT_TRUE(see_obstacle(known_object(1.2, 0.0, 0.05), {{0, 0}, 0}, driving(0.2F, 0)).in_path);
  // Mirror image: turning right.
  EXPECT_TRUE(see_obstacle(known_object(0.707, -0.293, 0.05), {{0, 0}, 0}, driving(0.2F, -0.2F)).in_path);
}

RobotPath with_body(RobotPath path, float front, float rear) {
  path.front = front;
  path.rear = rear;
  return path;
}

TEST(Obstacle, ALongNoseTouchesSooner) {
  const Obstacle seen = see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 0}, with_body(driving(0.2F), 0.4F, 0.05F));
  EXPECT_NEAR(seen.distance, 0.9F, 2e-3F) << "from the origin, as ever";
  EXPECT_NEAR(seen.ttc, (0.9F - 0.4F) / 0.2F, 0.02F);
  EXPECT_NEAR(seen.overhang, 0.3F, 1e-5F);
  const Obstacle plain = see_obstacle(known_object(1.0, 0, 0.1), {{0, 0}, 0}, driving(0.2F));
  EXPECT_EQ(plain.overhang, 0);
  EXPECT_NEAR(plain.ttc, (0.9F - 0.1F) / 0.2F, 0.02F);
}

// A straight front touches a post beside its middle once it is level with it: 0.49 m along the path, not 0.5 m.
TEST(Obstacle, AStraightFrontTouchesAllAlongItsEdge) {
  const Obstacle seen = see_obstacle(known_object(0.49, 0.1, 0.02), {{0, 0}, 0}, with_body(driving(0.2F), 0.3F, 0.05F));
  EXPECT_NEAR(seen.ttc, (0.49F * 0.48F / 0.5F - 0.3F) / 0.2F, 0.02F);
}

// Half a circle on, beside the robot now: its edge is level with the post, and does not touch it for long.
TEST(Obstacle, WhatIsFarAlongACurveIsNotSoonThere) {
  const RobotPath path = with_body(driving(0.2F, 0.5F), 0.1F, 0.2F);
  const Obstacle seen = see_obstacle(known_object(0.05, 0.8, 0.05), {{0, 0}, 0}, path);
  ASSERT_TRUE(seen.in_path && seen.closing);
  EXPECT_GT(seen.ttc, 3);
}

TEST(Obstacle, ReversingTowardsWhatIsBehindIsJudgedFromTheRear) {
  const Obstacle seen = see_obstacle(known_object(-0.6, 0, 0.1), {{0, 0}, 0}, with_body(driving(-0.2F), 0.1F, 0.3F));
  ASSERT_TRUE(seen.in_path);
  ASSERT_TRUE(seen.closing);
  EXPECT_NEAR(seen.ttc, (0.5F - 0.3F) / 0.2F, 0.02F);
  EXPECT_NEAR(seen.overhang, 0.2F, 1e-5F);
}

// Beside the tail that swings out to it, and beside the robot that spins.
TEST(Obstacle, WhatACornerHitsIsInThePath) {
  const auto post = known_object(-0.2, -0.18, 0.03);
  const auto seen = [&](float forward, float turn, float rear) {
    return see_obstacle(post, {{0, 0}, 0}, with_body(driving(forward, turn), 0.1F, rear)).in_path.has_value();
  };
  EXPECT_TRUE(seen(0.2F, 0.5F, 0.3F));
  EXPECT_FALSE(seen(0.2F, -0.5F, 0.3F)) << "that side draws away";
  EXPECT_FALSE(seen(0.2F, 0.5F, 0.1F)) << "behind the body";
  EXPECT_TRUE(seen(0, 0.5F, 0.3F));
  EXPECT_FALSE(seen(0, 0.5F, 0.1F)) << "the corners' circle is too small";
}

TEST(Obstacle, WithoutAnEstimateNothingIsKnown) {
  recon::ObjectCore object;
  EXPECT_FALSE(see_obstacle(object, {{0, 0}, 0}, driving(0.2F)).known);
}

}  // namespace
}  // namespace fencepost::test
