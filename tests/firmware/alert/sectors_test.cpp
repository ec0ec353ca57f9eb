#include "firmware/alert/sectors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "firmware/config/profile.hpp"
#include "tests/firmware/alert/box_outline.hpp"
#include "tests/firmware/alert/known_floor.hpp"
#include "tests/firmware/alert/known_object.hpp"

namespace fencepost::test {
namespace {

using alert::kSectors;
using alert::Sectors;

TEST(Sectors, WhatWasNotSeenIsUnknown) {
  const Sectors sectors({}, kHome, 150);
  for (std::size_t k = 0; k < kSectors; ++k) EXPECT_FALSE(sectors.range(k)) << k;
}

// 60 degrees are in view: the sectors at -20 to 20, from side to side.
TEST(Sectors, EmptyFloorIsAsFarAsItWasSeen) {
  for (const double heading : {0.0, 90.0, -135.0, 1000.0}) {
    const recon::MapPose robot = pose_at(12.3, -4.5, heading * kDegree);
    const Sectors sectors(floor_seen(robot, {0, 0, 0}), robot, 150);
    EXPECT_GT(sectors.range(0).value_or(0), 1300) << heading;
    for (std::size_t k = 4; k < 33; ++k) EXPECT_FALSE(sectors.range(k)) << k << " at " << heading;
  }
}

TEST(Sectors, ALookAroundKnowsAllOfThem) {
  const Sectors sectors(floor_seen_around(kHome), kHome, 250);
  for (std::size_t k = 0; k < kSectors; ++k) EXPECT_GT(sectors.range(k).value_or(0), 1200) << k;
}

// Each degree all around, each in one frame and at some distance: the sector is the one that holds it.
TEST(Sectors, APointIsInItsSector) {
  for (int degree = -179; degree <= 180; ++degree) {
    if (std::abs(degree) % 10 == 5) continue;  // on a border it is in both
    for (const double heading : {0.0, 137.0}) {
      const recon::MapPose robot = pose_at(1, 2, heading * kDegree);
      Sectors sectors({}, robot, 150);
      const double angle = (degree + heading) * kDegree;
      const recon::guard::Front front = front_at(1.2 * std::cos(angle), 1.2 * std::sin(angle));
      sectors.add({&front, 1}, robot.position);
      const auto sector = static_cast<std::size_t>(std::floor((degree + 365) / 10.0)) % kSectors;
      ASSERT_TRUE(sectors.range(sector)) << degree;
      EXPECT_NEAR(*sectors.range(sector), 1150, 3) << degree << ": 5 cm before a point between two others";
      EXPECT_FALSE(sectors.range((sector + 2) % kSectors)) << degree;
      EXPECT_FALSE(sectors.range((sector + kSectors - 2) % kSectors)) << degree;
    }
  }
}

// Its disc reaches 2.39 degrees to either side, over a border or not: 13 degrees to 15.39, for example.
TEST(Sectors, APointIsInAllTheSectorsOfItsDisc) {
  const auto sector_at = [](double degree) {
    return static_cast<std::size_t>(std::floor((degree + 365) / 10)) % kSectors;
  };
  const double reach = std::atan(0.05 / 1.2) / kDegree;
  for (int degree = -179; degree <= 180; ++degree) {
    Sectors sectors({}, kHome, 150);
    const recon::guard::Front front = front_at(1.2 * std::cos(degree * kDegree), 1.2 * std::sin(degree * kDegree));
    sectors.add({&front, 1}, {});
    const std::size_t first = sector_at(degree - reach);
    const std::size_t last = sector_at(degree + reach);
    for (std::size_t k = 0; k < kSectors; ++k) {
      EXPECT_EQ(sectors.range(k).has_value(), k == first || k == last) << degree << " in " << k;
    }
  }
}

TEST(Sectors, ARangeEndsBeforeFloorThatWasNotSeen) {
  // It looked from one metre back: floor from 0.5 to 1.5 m ahead of where it was.
  const recon::guard::SeenFloor floor = floor_seen(pose_at(-1, 0, 0), {0});
  Sectors sectors(floor, kHome, 150);
  ASSERT_TRUE(sectors.range(0));
  EXPECT_GT(*sectors.range(0), 300);
  EXPECT_LE(*sectors.range(0), 564) << "and a cell";
  const recon::guard::Front far = front_at(1.2, 0);
  sectors.add({&far, 1}, {});
  EXPECT_LE(*sectors.range(0), 564) << "something may stand before it";
  const recon::guard::Front near = front_at(0.6, 0);
  sectors.add({&near, 1}, {});
  EXPECT_NEAR(*sectors.range(0), 550, 3) << "its foot hides the floor before it";
}

// To the left, 17.5 degrees to each side; two sigmas nearer.
TEST(Sectors, ACylinderReachesOverSectors) {
  recon::Object<config::Small> object;
  static_cast<recon::ObjectCore&>(object) = known_object(0, 1.0, 0.3);
  Sectors sectors({}, kHome, 150);
  sectors.add(object, alert::RobotPlace(kHome));
  const int nearest = static_cast<int>(700 - 2000 * object.cylinder.estimate().outline_sigma());
  for (std::size_t k = 0; k < kSectors; ++k) {
    ASSERT_EQ(sectors.range(k).has_value(), k >= 7 && k <= 11) << k;
    EXPECT_NEAR(sectors.range(k).value_or(nearest), nearest, 2) << k;
  }
  object.id = 0;
  Sectors none({}, kHome, 150);
  none.add(object, alert::RobotPlace(kHome));
  EXPECT_FALSE(none.range(9));
}

// A wall 2 m long, 0.5 m to the right of the robot and along its way: nearest beside it, farther ahead.
TEST(Sectors, AnOutlineHasARangeForEachSector) {
  recon::Object<config::Small> object;
  static_cast<recon::ObjectCore&>(object) = known_object(0, -0.55, 0.1);
  BoxOutline(2.0F, 0.1F, 0.005F).put_into(object.hybrid(), {0, -55'000});
  for (const double heading : {0.0, 73.0}) {
    // The same place, the robot turned on: sectors move by whole ones only at multiples of ten degrees.
    const recon::MapPose robot = pose_at(0, 0, heading * kDegree);
    Sectors sectors({}, robot, 150);
    sectors.add(object, alert::RobotPlace(robot));
    for (int degree = -150; degree <= -30; ++degree) {
      const double at = (degree - heading);
      const auto sector = static_cast<std::size_t>(std::floor((at + 725) / 10.0)) % kSectors;
      const double exact = 500 / std::sin(-degree * kDegree);
      if (exact > 1000) continue;
      ASSERT_TRUE(sectors.range(sector)) << degree;
      EXPECT_LE(*sectors.range(sector), exact + 1) << degree;
      const double middle = 10.0 * static_cast<double>(sector) + heading;
      const double near = std::clamp(std::remainder(-90 - middle, 360.0), -5.0, 5.0) + middle;
      EXPECT_GE(*sectors.range(sector), -500 / std::sin(near * kDegree) - 95)
          << degree << ": a piece of 0.1 m, two sigmas";
    }
    const auto beside = static_cast<std::size_t>(std::floor((-90 - heading + 725) / 10.0)) % kSectors;
    EXPECT_NEAR(*sectors.range(beside), 490, 12);
  }
}

// 1.5 m; and 0.2 m of floor before a thing need not have been seen.
TEST(Sectors, ARangeIsKnownToItsEnds) {
  const auto range = [](const recon::guard::SeenFloor& floor, int mm) {
    Sectors sectors(floor, kHome, 150);
    const recon::guard::Front front = front_at(0.001 * (mm + 50), 0);
    sectors.add({&front, 1}, {});
    return sectors.range(0);
  };
  EXPECT_EQ(range({}, 1'500), 1'500);
  EXPECT_FALSE(range({}, 1'501));
  const recon::guard::SeenFloor floor = floor_seen(pose_at(-1, 0, 0), {0});
  const int free = Sectors(floor, kHome, 150).range(0).value_or(0);
  ASSERT_GT(free, 300);
  EXPECT_EQ(range(floor, free + 200), free + 200);
  EXPECT_EQ(range(floor, free + 201), free);
}

TEST(Sectors, InsideAThingAllRangesAreZero) {
  recon::Object<config::Small> object;
  static_cast<recon::ObjectCore&>(object) = known_object(0.1, 0, 0.3);
  const recon::guard::Front front = front_at(0.03, 0.03);
  recon::Object<config::Small> outlined = object;
  BoxOutline(1.0F, 2.0F, 0.005F).put_into(outlined.hybrid(), {10'000, 0});
  for (const int thing : {0, 1, 2}) {
    Sectors sectors({}, kHome, 150);
    thing == 0 ? sectors.add({&front, 1}, {}) : sectors.add(thing == 1 ? object : outlined, alert::RobotPlace(kHome));
    for (std::size_t k = 0; k < kSectors; ++k) EXPECT_EQ(sectors.range(k), 0) << thing << ", " << k;
  }
}

}  // namespace
}  // namespace fencepost::test
