#include "firmware/alert/swept_area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware/alert/tuning.hpp"

namespace fencepost::test {
namespace {

using alert::RobotPath;
using alert::SweptArea;

RobotPath path_of(float forward, float turn, float half_width = 0.15F) {
  RobotPath path;
  path.motion = {forward, turn};
  path.half_width = half_width;
  return path;
}

// Each bound at the bound.
TEST(LastWay, IsHowItSurelyWent) {
  using namespace alert;
  LastWay way;
  way.follow({kSurelyMoving, kSurelyTurning});
  EXPECT_FALSE(way.back);
  EXPECT_TRUE(way.turning);
  way.follow({-kSurelyMoving, std::nextafter(kSurelyTurning, 0.0F)});
  EXPECT_TRUE(way.back);
  EXPECT_FALSE(way.turning);
  way.follow({std::nextafter(kSurelyMoving, 0.0F), std::nextafter(kSpinning, 0.0F)});
  EXPECT_TRUE(way.back) << "it may stand";
  EXPECT_FALSE(way.turning);
  way.follow({0, -kSpinning});
  EXPECT_TRUE(way.back);
  EXPECT_TRUE(way.turning);
  way.follow({0, 0});
  EXPECT_TRUE(way.turning) << "one that stands may go on so";
}

TEST(Ways, WhichLeadOn) {
  using namespace alert;
  const auto ways = [](float forward, float turn) { return Ways(path_of(forward, turn)); };
  EXPECT_FALSE(ways(-kSurelyMoving, 0).ahead);
  EXPECT_TRUE(ways(std::nextafter(-kSurelyMoving, 0.0F), 0).ahead);
  EXPECT_FALSE(ways(-kStanding, 0).behind);
  EXPECT_TRUE(ways(std::nextafter(-kStanding, -1.0F), 0).behind);
  EXPECT_FALSE(ways(kStanding, 0.05F).arc);
  EXPECT_TRUE(ways(0.25F, 0.5F).arc);
  EXPECT_FALSE(ways(0.25F, 0.5F).straight);
  EXPECT_FALSE(ways(0.25F, 0.5F).spins);
  EXPECT_FLOAT_EQ(ways(0.25F, -0.5F).radius, -0.5F);
  EXPECT_FALSE(ways(0.5F, 0.01F).arc) << "a radius of 50 m is straight on";
  EXPECT_TRUE(ways(0.5F, 0.0101F).arc);
  EXPECT_TRUE(ways(0.05F, kSurelyTurning).arc);
  EXPECT_TRUE(ways(0.05F, kSurelyTurning).straight) << "and slow";
  EXPECT_FALSE(ways(0.05F, std::nextafter(kSurelyTurning, 0.0F)).arc);
  EXPECT_FALSE(ways(kSurelyMoving, 0.2F).straight) << "no more";
  EXPECT_TRUE(ways(0, kSurelyTurning).spins);
  EXPECT_FALSE(ways(0, std::nextafter(kSurelyTurning, 0.0F)).spins);
  EXPECT_TRUE(ways(0.1F, 0.7F).spins) << "a radius of 0.143 m";
  EXPECT_FALSE(ways(0.1F, 0.65F).spins) << "0.154 m";
}

// A stationary robot may go on as it went. A round body sweeps nothing by a spin, and a body on an arc does not spin.
TEST(Ways, OfARobotThatStandsAreThoseOfBefore) {
  RobotPath path = path_of(0, 0);
  path.last = {true, true};
  EXPECT_FALSE(alert::Ways(path).behind) << "round";
  EXPECT_FALSE(alert::Ways(path).spins);
  path.front = 0.2F;
  EXPECT_FALSE(alert::Ways(path).behind) << "its rear is";
  EXPECT_TRUE(alert::Ways(path).spins);
  path.rear = 0.2F;
  EXPECT_TRUE(alert::Ways(path).behind);
  path.last = {false, false};
  EXPECT_FALSE(alert::Ways(path).behind);
  EXPECT_FALSE(alert::Ways(path).spins);
  path.last = {true, true};
  path.motion = {0.05F, 0.2F};
  EXPECT_TRUE(alert::Ways(path).arc);
  EXPECT_FALSE(alert::Ways(path).spins);
  path.motion = {alert::kSurelyMoving, 0};
  EXPECT_FALSE(alert::Ways(path).behind) << "it surely goes ahead";
  EXPECT_FALSE(alert::Ways(path).spins);
}

TEST(SweptByBody, WhatReachesTheOriginIsTouched) {
  const alert::SweptByBody body(path_of(0.2F, 0));
  EXPECT_TRUE(body.touches({-0.5F, 0}, 0.75F));
  EXPECT_FALSE(body.touches({-0.5F, 0}, 0.5F)) << "it ends there";
  EXPECT_FALSE(body.touches({-0.5F, 0}, 0.25F));
}

TEST(SweptByBody, OfAPointIsOfADiscWithoutRadius) {
  RobotPath path = path_of(0.2F, 0.5F);
  path.front = 0.2F;
  path.rear = 0.1F;
  const alert::SweptByBody body(path);
  const auto bounds = body.bounds_of(0);
  int touched = 0;
  for (float x = -0.5F; x < 1; x += 0.07F) {
    for (float y = -0.5F; y < 1; y += 0.07F) {
      EXPECT_EQ(body.touches({x, y}, bounds), body.touches({x, y}, 0)) << x << " " << y;
      touched += body.touches({x, y}, bounds) ? 1 : 0;
    }
  }
  EXPECT_GT(touched, 20);
}

TEST(SweptArea, IsTheStripAhead) {
  const SweptArea area(path_of(0.2F, 0), 0.03F);
  EXPECT_TRUE(area.contains(300, 0));
  EXPECT_TRUE(area.contains(300, 120));
  EXPECT_TRUE(area.contains(300, -120));
  EXPECT_FALSE(area.contains(300, 121));
  EXPECT_FALSE(area.contains(300, -121));
  EXPECT_FALSE(area.contains(-300, 0));
}

// The same as distances from the pivot say, for all radii and places within reach.
TEST(SweptArea, IsWhatTheDistanceFromThePivotSays) {
  for (const float radius : {0.16F, 0.3F, 1.0F, 5.0F, 49.0F}) {
    for (const float half_width : {0.05F, 0.15F, 0.6F, 2.5F}) {
      const SweptArea area(path_of(0.5F, 0.5F / radius, half_width), 0);
      const double pivot = 1000 * double{radius}, half = 1000 * double{half_width};
      for (int x = 50; x <= 3950; x += 130) {
        for (int y = -3950; y <= 3950; y += 130) {
          const double off = std::fabs(std::hypot(x, y - pivot) - pivot) - half;
          if (std::fabs(off) < 2) continue;  // rounding
          EXPECT_EQ(area.contains(x, y), off < 0) << radius << " " << half_width << " " << x << " " << y;
        }
      }
    }
  }
}

using alert::SweptByBody;

// 0.2 m wide, margin 0.05 m.
RobotPath body_of(float front, float rear, float forward, float turn = 0) {
  RobotPath path = path_of(forward, turn);
  path.front = front;
  path.rear = rear;
  return path;
}

TEST(Footprint, StraightOnIsTheBodyAndWhatIsAheadOfIt) {
  const SweptArea area(body_of(0.3F, 0.2F, 0.2F), 0);
  EXPECT_TRUE(area.contains(900, 149));
  EXPECT_FALSE(area.contains(900, 151));
  EXPECT_TRUE(area.contains(-190, 140)) << "beside the tail, in the margin";
  EXPECT_FALSE(area.contains(-201, 140)) << "passed";
  EXPECT_FALSE(area.contains(-100, 49)) << "nothing can be in the body";
  const SweptArea back(body_of(0.3F, 0.2F, -0.2F), 0);
  EXPECT_TRUE(back.contains(-900, 149));
  EXPECT_TRUE(back.contains(290, 140));
  EXPECT_FALSE(back.contains(301, 0));
}

TEST(Footprint, OfWidthAloneIsRound) {
  for (const float turn : {0.0F, 0.5F, 2.0F}) {
    const SweptArea area(body_of(0, 0, 0.1F, turn), 0);
    EXPECT_FALSE(area.contains(-10, 120)) << turn;
    EXPECT_FALSE(area.contains(-10, -120)) << turn;
    EXPECT_EQ(area.overhang().ahead, 0);
    EXPECT_EQ(area.overhang().behind, 0);
  }
}

// On a circle of 0.35 m to the left the rear's outer corner is sqrt(0.45^2 + 0.3^2) = 0.541 m from the pivot. That is
// 0.091 m farther than the side, and 0.591 m with the margin. Beside the tail, 0.2 m behind, the area therefore ends at
// y = 0.35 - sqrt(0.591^2 - 0.2^2).
TEST(Footprint, TheTailSwingsOut) {
  const SweptArea area(body_of(0.1F, 0.3F, 0.2F, 0.2F / 0.35F), 0);
  EXPECT_TRUE(area.contains(-200, -204));
  EXPECT_FALSE(area.contains(-200, -208));
  EXPECT_FALSE(area.contains(-301, -120)) << "behind its corner";
  EXPECT_FALSE(area.contains(-200, 130)) << "the inner side draws away";
  EXPECT_FALSE(area.contains(0, 130));
  EXPECT_TRUE(area.contains(1, 130));
  EXPECT_TRUE(area.contains(541, 350 + 20)) << "a quarter of a circle on, the corner comes by";
  const SweptArea right(body_of(0.1F, 0.3F, 0.2F, -0.2F / 0.35F), 0);
  EXPECT_TRUE(right.contains(-200, 204));
  EXPECT_FALSE(right.contains(-200, 208));
  EXPECT_FALSE(SweptArea(body_of(0.1F, 0.1F, 0.2F, 0.2F / 0.35F), 0).contains(-101, -160)) << "a short tail";
}

// sqrt(0.35^2 + 0.25^2) + 0.05 = 0.480 m from the pivot; the side goes to 0.4 m.
TEST(Footprint, TheNoseSwingsOutAheadOfTheRobot) {
  const SweptArea area(body_of(0.25F, 0.05F, 0.25F, 1), 0);
  EXPECT_TRUE(area.contains(330, 250 - 345));
  EXPECT_TRUE(area.contains(475, 250));
  EXPECT_FALSE(area.contains(485, 250));
  EXPECT_FALSE(SweptArea(path_of(0.25F, 1), 0).contains(475, 250));
  EXPECT_FALSE(area.contains(100, -180)) << "beside the body: the nose has passed, the tail is short";
  const SweptArea back(body_of(0.05F, 0.25F, -0.25F, -1), 0);  // the mirror image
  EXPECT_TRUE(back.contains(-475, 250));
  EXPECT_FALSE(back.contains(-100, -180));
}

// The corners' circle: sqrt(0.3^2 + 0.1^2) + 0.05 = 0.366 m.
TEST(Footprint, SpinningSweepsACircle) {
  for (const float turn : {0.5F, -0.5F}) {
    const SweptArea area(body_of(0.1F, 0.3F, 0, turn), 0);
    EXPECT_TRUE(area.contains(0, 365));
    EXPECT_TRUE(area.contains(-250, -265));
    EXPECT_TRUE(area.contains(-365, 0));
    EXPECT_FALSE(area.contains(-370, 0));
    EXPECT_FALSE(area.contains(0, 370));
  }
  EXPECT_FALSE(SweptArea(body_of(0.1F, 0.3F, 0, 0.1F), 0).contains(0, 300)) << "odometry that wavers is no spin";
  EXPECT_FALSE(SweptArea(path_of(0, 0.5F), 0).contains(0, 120)) << "a round body stays where it is";
}

TEST(Footprint, ThresholdsMoveByWhatReachesBeyondHalfTheWidth) {
  const auto overhang = [](float front, float rear, float forward, float turn) {
    return SweptArea(body_of(front, rear, forward, turn), 0).overhang();
  };
  EXPECT_NEAR(overhang(0.3F, 0.2F, 0.2F, 0).ahead, 0.2, 1e-5);
  EXPECT_NEAR(overhang(0.3F, 0.2F, 0.2F, 0).behind, std::hypot(0.2, 0.1) - 0.1, 1e-5) << "a corner may swing out";
  EXPECT_NEAR(overhang(0.3F, 0.2F, -0.2F, 0).behind, 0.1, 1e-5);
  EXPECT_NEAR(overhang(0.3F, 0.2F, 0, 1).ahead, std::hypot(0.3, 0.1) - 0.1, 1e-5);
  EXPECT_EQ(overhang(0.05F, 0, 0.2F, 0).ahead, 0) << "a short nose brings no stop later than alert.stop";
}

// m from a rectangle around the origin, robot frame.
double from_body(const RobotPath& path, double x, double y) {
  const double ahead = std::max({x - double{path.front}, -double{path.rear} - x, 0.0});
  const double aside = std::max(std::fabs(y) - double{path.body_radius}, 0.0);
  return std::hypot(ahead, aside);
}

// The nearest that the body comes to a place within the next 60 degrees or 0.6 m of its motion.
double nearest_on_the_way(const RobotPath& path, double x, double y) {
  const double forward = double{path.motion.forward};
  const double turn = double{path.motion.turn};
  const double seconds = std::min(1.05 / std::max(1e-9, std::fabs(turn)), 0.6 / std::max(1e-9, std::fabs(forward)));
  double least = 1;
  for (int i = 0; i <= 200; ++i) {
    const double t = seconds * i / 200;
    const double heading = turn * t;
    const double half = heading / 2;
    const double chord = forward * t * (std::fabs(half) > 1e-9 ? std::sin(half) / half : 1);
    const double dx = x - chord * std::cos(half);
    const double dy = y - chord * std::sin(half);
    least = std::min(least, from_body(path, std::cos(heading) * dx + std::sin(heading) * dy,
                                      std::cos(heading) * dy - std::sin(heading) * dx));
  }
  return least;
}

// Whatever the body comes to touch is in the area; bodies with corners at both ends.
TEST(Footprint, HoldsWhatTheBodyMeets) {
  int met = 0;
  for (const auto& [front, rear] : {std::pair{0.3F, 0.05F}, {0.05F, 0.3F}, {0.2F, 0.2F}, {0.01F, 0.01F}}) {
    for (const auto& [forward, turn] : {std::pair{0.2F, 0.0F},
                                        {-0.2F, 0.0F},
                                        {0.2F, 0.5F},
                                        {0.2F, -1.1F},
                                        {-0.2F, 0.8F},
                                        {-0.2F, -1.2F},
                                        {0.2F, 2.0F},
                                        {0.04F, 0.2F},
                                        {0.0F, 0.5F},
                                        {0.02F, -0.5F}}) {
      const RobotPath path = body_of(front, rear, forward, turn);
      const SweptArea points(path, 0);
      const SweptByBody discs(path);
      for (int x = -700; x <= 700; x += 28) {
        for (int y = -700; y <= 700; y += 28) {
          if (from_body(path, 1e-3 * x, 1e-3 * y) < 0.06) continue;  // it is there now
          const double nearest = nearest_on_the_way(path, 1e-3 * x, 1e-3 * y);
          const auto where = [&] {
            return testing::Message() << front << " " << rear << ", " << forward << " " << turn << ": " << x << " "
                                      << y;
          };
          if (nearest < 0.001) {
            EXPECT_TRUE(points.contains(x, y)) << where();
          }
          const recon::Vec2 center = 1e-3F * recon::Vec2(static_cast<float>(x), static_cast<float>(y));
          if (nearest < 0.05) {
            EXPECT_TRUE(discs.touches(center, 0.05F)) << where();
          }
          met += nearest < 0.001 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(met, 1000);
}

// Points of a front are 64 mm apart.
TEST(SweptArea, IsNeverNarrowerThanTheGuardsPointsAreApart) {
  const SweptArea area(path_of(0.2F, 0, 0.02F), 0.03F);
  EXPECT_TRUE(area.contains(300, 32));
  EXPECT_FALSE(area.contains(300, 33));
}

}  // namespace
}  // namespace fencepost::test
