#include "firmware/alert/free_ways.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "firmware/config/profile.hpp"
#include "tests/firmware/alert/box_outline.hpp"
#include "tests/firmware/alert/known_floor.hpp"
#include "tests/firmware/alert/known_object.hpp"

namespace fencepost::test {
namespace {

using alert::FreeWays;
using alert::PassingSide;
using record::WayEnd;
using Way = record::WayReport::Way;

constexpr std::size_t kSpin = 0;
constexpr std::size_t kSharpLeft = 1;
constexpr std::size_t kStraight = 4;
constexpr std::size_t kSharpRight = 7;
constexpr std::size_t kBack = 8;

const recon::guard::SeenFloor kSeenAround = floor_seen_around(kHome);

alert::AlertRules rules() { return alert::AlertRules(config::Settings{}); }

Way way_of(const FreeWays& ways, std::size_t index, const recon::guard::SeenFloor& floor,
           const recon::MapPose& robot = kHome) {
  return ways.way(index, floor, alert::RobotPlace(robot), rules());
}

TEST(FreeWays, WhatWasNotSeenIsUnknown) {
  const FreeWays ways((alert::RobotPath()));
  for (std::size_t k = kSharpLeft; k < FreeWays::kWays; ++k) {
    const Way way = way_of(ways, k, {});
    EXPECT_EQ(way.end, WayEnd::kUnknown) << k;
    EXPECT_LE(way.free.to_double(), 0.25) << k << ": beside the body nothing has to be seen";
  }
  const Way spin = way_of(ways, kSpin, {});
  EXPECT_EQ(spin.end, WayEnd::kNothing) << "a round body stays where it is";
  EXPECT_NEAR(spin.free.to_double(), std::numbers::pi, 1e-3);
}

TEST(FreeWays, AThingAheadEndsTheWaysThatMeetIt) {
  FreeWays ways((alert::RobotPath()));
  const recon::guard::Front front = front_at(0.8, 0);
  ways.add({&front, 1}, {}, alert::RobotPlace(kHome));
  EXPECT_EQ(way_of(ways, kStraight, kSeenAround).end, WayEnd::kThing);
  EXPECT_NEAR(way_of(ways, kStraight, kSeenAround).free.to_double(), 0.65, 0.002) << "its disc and the body's radius";
  EXPECT_EQ(way_of(ways, kSharpLeft, kSeenAround).end, WayEnd::kNothing);
  EXPECT_EQ(way_of(ways, kSharpRight, kSeenAround).end, WayEnd::kNothing);
  EXPECT_EQ(way_of(ways, kBack, kSeenAround).end, WayEnd::kNothing);
}

TEST(FreeWays, AnObjectCountsByItsOutlineWhereThatIsKnown) {
  recon::Object<config::Small> object;
  static_cast<recon::ObjectCore&>(object) = known_object(0.8, 0, 0.1);
  FreeWays by_cylinder((alert::RobotPath()));
  by_cylinder.add(object, alert::RobotPlace(kHome), PassingSide::kAny);
  EXPECT_NEAR(way_of(by_cylinder, kStraight, kSeenAround).free.to_double(), 0.6, 0.03);

  // A wall across the way, 1 m wide.
  BoxOutline(0.04F, 1.0F, 0.002F).put_into(object.hybrid(), pose_at(0.8, 0, 0).position);
  ASSERT_TRUE(object.hybrid().ok());
  FreeWays by_outline((alert::RobotPath()));
  by_outline.add(object, alert::RobotPlace(kHome), PassingSide::kAny);
  EXPECT_NEAR(way_of(by_outline, kStraight, kSeenAround).free.to_double(), 0.65, 0.04);
  for (const std::size_t k : {std::size_t{3}, std::size_t{5}}) {
    EXPECT_EQ(way_of(by_outline, k, kSeenAround).end, WayEnd::kThing) << k;
  }
  object.id = 0;
  FreeWays none((alert::RobotPath()));
  none.add(object, alert::RobotPlace(kHome), PassingSide::kAny);
  EXPECT_NE(way_of(none, kStraight, kSeenAround).end, WayEnd::kThing);
}

// As far as the middle of a thin pillar, less what is ahead of the origin. On an arc of 0.3125 m to the left it is
// atan2(0.6, 0.3125) - asin(0.1 / 0.6765) on.
TEST(FreeWays, APillarIsPassedOnTheSideThatItAsksFor) {
  recon::Object<config::Small> pillar;
  const auto until = [&](double x, double y, PassingSide side, std::size_t k) {
    static_cast<recon::ObjectCore&>(pillar) = known_object(x, y, 0.01);
    FreeWays ways((alert::RobotPath()));
    ways.add(pillar, alert::RobotPlace(kHome), side);
    const Way way = way_of(ways, k, kSeenAround);
    return way.end == WayEnd::kThing ? way.free.to_double() : -1;
  };
  const auto any = PassingSide::kAny, left = PassingSide::kLeft, right = PassingSide::kRight;
  EXPECT_EQ(until(0.6, 0, any, kSharpLeft), -1);
  EXPECT_NEAR(until(0.6, 0, right, kSharpLeft), 0.2945, 3e-3) << "that would pass it on its left";
  EXPECT_NEAR(until(0.6, 0, left, kSharpRight), 0.2945, 3e-3);
  EXPECT_EQ(until(0.6, 0, right, kSharpRight), -1);
  EXPECT_EQ(until(0.6, 0, left, kSharpLeft), -1);
  EXPECT_NEAR(until(0.6, 0, right, kStraight), 0.49, 0.02) << "it stands in the way of that";
  EXPECT_NEAR(until(0.6, 0.5, left, kStraight), 0.5, 3e-3);
  EXPECT_NEAR(until(0.6, -0.5, right, kStraight), 0.5, 3e-3);
  EXPECT_EQ(until(0.6, 0.5, right, kStraight), -1);
  EXPECT_EQ(until(0.6, -0.5, left, kStraight), -1);
  EXPECT_EQ(until(0.05, 0.5, left, kStraight), 0) << "beside it";
  EXPECT_NEAR(until(0.06, 0.3, left, kSharpLeft), 0, 3e-3) << "nearer to the pivot than the front";
  EXPECT_EQ(until(-0.1, 0.5, left, kStraight), -1) << "passed";
  EXPECT_EQ(until(0.6, 1.6, left, kStraight), -1) << "farther aside than floor is known";
  EXPECT_EQ(until(-0.6, 0, left, kBack), until(-0.6, 0, any, kBack)) << "only on the way ahead";
  EXPECT_EQ(until(0.6, 0, right, kSpin), -1);
}

TEST(FreeWays, ACornerNeedsRoomToTurnOnTheSpot) {
  alert::RobotPath body;
  body.front = 0.25F;
  body.rear = 0.05F;
  FreeWays ways(body);
  EXPECT_EQ(way_of(ways, kSpin, kSeenAround).end, WayEnd::kNothing);
  EXPECT_EQ(way_of(ways, kSpin, floor_seen(kHome, {0})).end, WayEnd::kUnknown);
  const recon::guard::Front behind = front_at(-0.25, 0.1);
  ways.add({&behind, 1}, {}, alert::RobotPlace(kHome));
  const Way spin = way_of(ways, kSpin, kSeenAround);
  EXPECT_EQ(spin.end, WayEnd::kThing);
  EXPECT_EQ(spin.free.raw, 0);
  EXPECT_EQ(spin.speed.raw, 0);
}

// At that speed no STOP is due by the distance or the time to contact. Somewhat faster it is.
TEST(FreeWays, ASpeedLeavesTimeToSlowDownBeforeAStop) {
  const alert::AlertRules limits = rules();
  for (const double x : {0.3, 0.4, 0.5, 0.8, 1.2}) {
    FreeWays ways((alert::RobotPath()));
    const recon::guard::Front front = front_at(x, 0);
    ways.add({&front, 1}, {}, alert::RobotPlace(kHome));
    const Way way = way_of(ways, kStraight, kSeenAround);
    const auto stops_at = [&](float speed) {
      alert::RobotPath path;
      path.motion.forward = speed;
      alert::Obstacle obstacle;
      obstacle.known = true;
      obstacle.distance = way.free.to_float() + path.body_radius;
      obstacle.toward = {obstacle.distance, 0};
      obstacle.in_path.emplace();
      alert::set_closing(path, obstacle);
      const float next = obstacle.closing ? alert::kLookSeconds * speed : 0;
      return obstacle.distance - next < limits.stop || (obstacle.closing && obstacle.ttc < limits.ttc_stop);
    };
    const float speed = way.speed.to_float();
    const float later = (limits.ttc_stop + alert::kSlowsWithin) / limits.ttc_stop;
    EXPECT_TRUE(speed == 0 || !stops_at(0.99F * speed)) << x;
    EXPECT_TRUE(stops_at(1.01F * later * speed + 0.02F)) << x;
  }
}

// The body as a rectangle with its margin at the sides, moved along the way in steps of 2 mm.
double touched_after(const alert::RobotPath& body, std::size_t index, double x, double y, double radius) {
  constexpr double kCurvatures[] = {0, 3.2, 1.6, 0.8, 0, -0.8, -1.6, -3.2, 0};
  const double front = double{std::max(body.front, body.body_radius)};
  const double rear = index == kBack ? double{std::max(body.rear, body.body_radius)} : double{body.rear};
  const double sign = index == kBack ? -1 : 1;
  const double curvature = kCurvatures[index];
  const double most = curvature == 0 ? 1.5 : std::min(1.5, std::numbers::pi / std::abs(curvature));
  for (int i = 0; 0.002 * i < most; ++i) {
    const double gone = 0.002 * i;
    const double heading = curvature * gone;
    const double at_x = curvature == 0 ? sign * gone : std::sin(heading) / curvature;
    const double at_y = curvature == 0 ? 0 : (1 - std::cos(heading)) / curvature;
    const double dx = x - at_x;
    const double dy = y - at_y;
    const double along = std::cos(heading) * dx + std::sin(heading) * dy;
    const double left = std::cos(heading) * dy - std::sin(heading) * dx;
    const double out_x = std::max({along - front, -rear - along, 0.0});
    const double out_y = std::max(std::abs(left) - double{body.half_width}, 0.0);
    if (std::hypot(out_x, out_y) < radius) return gone;
  }
  return most;
}

TEST(FreeWays, NoWayIsLongerThanABodyThatIsMovedAlongIt) {
  std::mt19937 random(28);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  constexpr double kRadius = 0.05;  // of a front
  int met = 0;
  for (int i = 0; i < 3'000; ++i) {
    alert::RobotPath body;
    if (i % 3 != 0) body.front = static_cast<float>(between(0.1, 0.3));
    if (i % 3 == 2) body.rear = static_cast<float>(between(0.1, 0.3));
    const double x = 0.001 * std::round(between(-700, 1'200));
    const double y = 0.001 * std::round(between(-900, 900));
    if (touched_after(body, kBack, x, y, kRadius) == 0 || touched_after(body, kStraight, x, y, kRadius) == 0) continue;
    FreeWays ways(body);
    const recon::guard::Front front = front_at(x, y);
    ways.add({&front, 1}, {}, alert::RobotPlace(kHome));
    for (std::size_t k = kSharpLeft; k <= kBack; ++k) {
      const Way way = way_of(ways, k, kSeenAround);
      const double truth = touched_after(body, k, x, y, kRadius);
      EXPECT_LE(way.free.to_double(), truth + 0.004) << i << " way " << k << " at " << x << ", " << y;
      if (way.end != WayEnd::kThing) continue;
      ++met;
      // The disc counts as the square around it.
      const double least = touched_after(body, k, x, y, 1.42 * kRadius);
      EXPECT_GE(way.free.to_double(), least - 0.004) << i << " way " << k << " at " << x << ", " << y;
    }
  }
  EXPECT_GT(met, 1'000);
}

}  // namespace
}  // namespace fencepost::test
