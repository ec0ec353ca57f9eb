// A robot that lost its place, in random rooms: how soon it knows it again, and that it is never wrong.
#include "host/relocation/relocation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::recon {
namespace {

constexpr float kPi = 3.14159265F;
constexpr float kHalfView = 0.5F;  // rad
constexpr float kFarthest = 4;     // m

using Room = std::vector<ConstellationPoint>;

/// Things in a square of 6 m, at least half a metre apart.
Room room(std::mt19937& random, int things, int colours) {
  std::uniform_real_distribution<float> place(-3, 3);
  Room all;
  while (static_cast<int>(all.size()) < things) {
    const ConstellationPoint next{{place(random), place(random)},
                                  0.03F,
                                  0.05F,
                                  static_cast<std::uint8_t>(1 + static_cast<int>(all.size()) % colours)};
    bool free = true;
    for (const ConstellationPoint& other : all) free = free && (other.place - next.place).squared_norm() > 0.25F;
    if (free) all.push_back(next);
  }
  return all;
}

TEST(Relocation, ARadiusIsKnownFromThingsOfThatColourThatHaveOne) {
  const Room points = {{{0, 0}, 0, 0.04F, 1}, {{1, 0}, 0, 0.06F, 1}, {{2, 0}, 0, 0.5F, 2}, {{3, 0}, 0, 0, 3}};
  const std::optional<KnownRadius> radius = radius_of(points, 1);
  ASSERT_TRUE(radius.has_value());
  EXPECT_FLOAT_EQ(radius->mean, 0.05F);
  EXPECT_NEAR(radius->sigma, 0.01F, 1e-6F);        // 0.04 and 0.06
  EXPECT_FALSE(radius_of(points, 3).has_value());  // it has none
  EXPECT_FALSE(radius_of(points, 4).has_value());  // nothing has that colour
  EXPECT_FALSE(radius_of({}, 1).has_value());
}

struct Answer {
  float after = 0;  ///< s
  float off = 0;    ///< m
  float turn = 0;   ///< rad
};

/// Four frames a second while it drives arcs of a metre and turns at the walls. Odometry counts from the start, and
/// strays by 3 % of each step and 3 % of each turn. `truth`: the things in the room; `known`: the map.
std::optional<Answer> drive(std::mt19937& random, const Room& truth, const Room& known, float seconds) {
  std::uniform_real_distribution<float> even(-1, 1);
  std::normal_distribution<float> normal(0, 1);
  Vec2 place{2 * even(random), 2 * even(random)};
  float heading = kPi * even(random);
  float told = 0;  // odometry's heading; its places do not matter, steps do
  RelocationFilter filter(known);
  constexpr float kStep = 0.25F;  // s
  constexpr float kSpeed = 0.2F;  // m/s
  float rate = 0;
  for (float t = 0; t <= seconds; t += kStep) {
    if (std::fmod(t, 4.0F) < kStep / 2) rate = 0.5F * even(random);
    if (place.squared_norm() > 4 && cross(place, {std::cos(heading), std::sin(heading)}) != 0) {
      const bool outwards = place.dot(Vec2(std::cos(heading), std::sin(heading))) > 0;
      if (outwards) rate = 0.7F;
    }
    const float turned = rate * kStep;
    heading += turned;
    place += kSpeed * kStep * Vec2(std::cos(heading), std::sin(heading));
    const float seen_turn = turned * (1 + 0.03F * normal(random));
    told += seen_turn;
    filter.drive(kSpeed * kStep * (1 + 0.03F * normal(random)) * Vec2(std::cos(told), std::sin(told)), seen_turn);
    for (const ConstellationPoint& thing : truth) {
      const Vec2 away = thing.place - place;
      const float range = away.norm();
      const float bearing = std::remainder(std::atan2(away.y(), away.x()) - heading, 2 * kPi);
      if (range > kFarthest || range < 0.2F || std::fabs(bearing) > kHalfView) continue;
      const float seen = told + bearing + 0.01F * normal(random);
      RangedSighting sighted;
      sighted.direction = {std::cos(seen), std::sin(seen)};
      sighted.range = range * (1 + 0.05F * normal(random));
      sighted.from_robot = sighted.range * sighted.direction;
      sighted.along = 0.0025F * range * range;
      sighted.across = 0.0001F * range * range;
      filter.see(sighted, thing.signature);
    }
    const auto found = filter.found();
    if (!found) continue;
    const float direction = std::atan2(found->rotation.y(), found->rotation.x()) + told;
    return Answer{t, (found->place - place).norm(), std::remainder(direction - heading, 2 * kPi)};
  }
  return std::nullopt;
}

struct Sum {
  int soon = 0;  ///< right within 15 s
  int right = 0;
  int wrong = 0;
};

#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
constexpr int kRooms = 20;  // tests/studies/relocation has all
#else
constexpr int kRooms = 200;
#endif
constexpr int kWrong = (kRooms + 99) / 100;  // 1 in 100

/// `strange`: the map is of another room with the same colours.
Sum drives(unsigned seed, int things, int colours, bool strange) {
  Sum sum;
  for (int i = 0; i < kRooms; ++i) {
    std::mt19937 random(seed + static_cast<unsigned>(i));
    const Room truth = room(random, things, colours);
    const Room known = strange ? room(random, things, colours) : truth;
    const std::optional<Answer> answer = drive(random, truth, known, 60);
    if (!answer) continue;
    const bool right = !strange && answer->off < 0.4F && std::fabs(answer->turn) < 0.25F;
    ++(right ? sum.right : sum.wrong);
    if (right && answer->after <= 15) ++sum.soon;
  }
  std::printf("  %2d things, %2d colours%s: %d of %d right within 15 s, %d within 60 s, %d wrong\n", things, colours,
              strange ? ", another room" : "", sum.soon, kRooms, sum.right, sum.wrong);
  return sum;
}

// Seeds on which nothing was chosen; kMaxDoubt was, on those from 60,001 to 62,200.
TEST(Relocation, KnowsItsPlaceAgainByThingsOfOwnColours) {
  const Sum sum = drives(65'001, 8, 8, false);
  EXPECT_GE(sum.soon, kRooms / 2);
  EXPECT_GE(sum.right, kRooms * 9 / 10);
  EXPECT_LE(sum.wrong, kWrong);
}

TEST(Relocation, ByFewColoursLaterAndSeldomWrong) {
  for (const int colours : {4, 2, 1}) {
    const Sum sum = drives(66'001, 8, colours, false);
    EXPECT_GE(sum.right, kRooms / 4) << colours;
    EXPECT_LE(sum.wrong, kWrong) << colours;
  }
}

TEST(Relocation, InAnotherRoomItIsSeldomSure) {
  for (const int colours : {8, 2, 1}) EXPECT_LE(drives(64'001, 8, colours, true).wrong, kWrong) << colours;
}

TEST(Relocation, OfEqualPostsInASquareItIsNeverSure) {
  const float a = 1.2F;
  const Room square = {
      {{a, a}, 0.02F, 0.05F, 1}, {{-a, a}, 0.02F, 0.05F, 1}, {{-a, -a}, 0.02F, 0.05F, 1}, {{a, -a}, 0.02F, 0.05F, 1}};
  for (unsigned seed = 63'001; seed <= 63'040; ++seed) {
    std::mt19937 random(seed);
    EXPECT_FALSE(drive(random, square, square, 60)) << seed;
  }
  // Own colours tell them apart.
  Room told = square;
  for (std::size_t i = 0; i < told.size(); ++i) told[i].signature = static_cast<std::uint8_t>(1 + i);
  int right = 0;
  for (unsigned seed = 63'001; seed <= 63'040; ++seed) {
    std::mt19937 random(seed);
    if (const auto answer = drive(random, told, told, 60)) right += answer->off < 0.4F ? 1 : 0;
  }
  EXPECT_GE(right, 10);
}

TEST(Relocation, ARangeFollowsFromTheWidthOfAKnownThing) {
  Sighting sighting;
  sighting.focal = 300;
  const float half = 0.04F;
  const Vec2 left{std::sqrt(1 - half * half), half};
  sighting.left = {left, End::kSeen};
  sighting.right = {{left.x(), -left.y()}, End::kSeen};
  const auto ranged = recon::ranged(sighting, {0.04F, 0.002F}, {});
  ASSERT_TRUE(ranged);
  EXPECT_NEAR(ranged->range, 1.0F, 1e-3F);
  EXPECT_NEAR(ranged->from_robot.x(), 1.0F, 1e-3F);
  EXPECT_GT(std::sqrt(ranged->along), 0.05F) << "5 % by the radius alone";
  EXPECT_FALSE(recon::ranged(sighting, {0.04F, 0.03F}, {})) << "of a radius that is not known";
  sighting.left.end = End::kLowerBound;
  EXPECT_FALSE(recon::ranged(sighting, {0.04F, 0.002F}, {})) << "cut off";
}

// A row of the foot says less or more than the width; both together say more than either.
TEST(Relocation, ARangeFollowsFromWidthAndFootTogether) {
  test::Draw draw(111);
  test::Sweep sweep;
  for (int i = 0; i < 4'000; ++i) {
    Sighting sighting;
    sighting.focal = 256;
    sighting.lens = {0.125F, draw.of({0.0F, 0.0625F})};
    sighting.lens_height = 0.125F;
    sighting.rows_known = !draw.one_in(6);
    sighting.center = draw.of<Vec2>({{1, 0}, {0.8F, 0.6F}, {0.6F, -0.8F}, {0, 1}});
    sighting.axis = draw.of<Vec2>({{1, 0}, {0, 1}, {-1, 0}});
    const float half = draw.of({0.0F, 0.03125F, 0.0625F, -0.03125F});
    const auto edge = [&](float aside) -> Ray {
      return {sighting.center + aside * left_of(sighting.center), draw.one_in(8) ? End::kLowerBound : End::kSeen};
    };
    sighting.left = edge(half);
    sighting.right = edge(-half);
    sighting.bottom = {draw.of({0.0F, 0.0625F, 0.125F, 0.25F}), draw.one_in(6) ? End::kLowerBound : End::kSeen};
    const KnownRadius radius{0.0625F, draw.of({0.0F, 0.015625F, 0.02125F, 0.03125F})};
    const auto range = ranged(sighting, radius, {});
    sweep.tell("known", range.has_value());
    if (!range) continue;
    sweep.tell("range", range->range);
    sweep.tell("along", range->along);
    sweep.tell("across", range->across);
    sweep.tell("x", range->from_robot.x());
    sweep.tell("y", range->from_robot.y());
  }
  expect_said(sweep, {"known 956 1ad05119", "range 956 102c8bdd", "along 956 15a1b725", "across 956 00d0d63f",
                      "x 956 49dfd13d", "y 842 fde70266"});
}

// A robot on a lattice, in rooms of things on a lattice. They have few colours, and some are not where they should be.
// The filter's answers and their certainty are compared after each sighting.
TEST(Relocation, OfThingsOnALattice) {
  test::Draw draw(112);
  test::Sweep sweep;
  for (int run = 0; run < 60; ++run) {
    Room known;
    const int things = draw.between(3, 9);
    for (int i = 0; i < things; ++i) {
      known.push_back({{draw.steps(-4, 4, 0.5F), draw.steps(-4, 4, 0.5F)},
                       draw.of({0.0F, 0.03125F}),
                       0.0625F,
                       static_cast<std::uint8_t>(1 + i % draw.of({2, 9}))});
    }
    const auto filter = std::make_unique<RelocationFilter>(known);
    Vec2 place{draw.steps(-2, 2, 0.5F), draw.steps(-2, 2, 0.5F)};
    for (int look = 0; look < 14; ++look) {
      const Vec2 step{draw.steps(-1, 1, 0.125F), draw.steps(-1, 1, 0.125F)};
      filter->drive(step, draw.of({0.0F, 0.0F, 0.0078125F, -0.0078125F}));
      place += step;
      const ConstellationPoint& thing = known[static_cast<std::size_t>(draw.between(0, things - 1))];
      RangedSighting sighted;
      sighted.from_robot = thing.place - place;
      if (draw.one_in(6)) sighted.from_robot += Vec2(draw.steps(-2, 2, 0.25F), 0);
      sighted.range = sighted.from_robot.norm();
      if (sighted.range < 0.1F) continue;
      sighted.direction = sighted.from_robot / sighted.range;
      sighted.along = 0.0009765625F;
      sighted.across = 0.000244140625F;
      filter->see(sighted, draw.one_in(12) ? std::uint8_t{9} : thing.signature);
      const auto found = filter->found();
      sweep.tell("found", found.has_value());
      if (!found) continue;
      sweep.tell("place", found->place.x() + 16 * found->place.y());
      sweep.tell("rotation", found->rotation.x() + 16 * found->rotation.y());
      sweep.tell("doubt", found->doubt);
      sweep.tell("met", found->met);
    }
  }
  expect_said(sweep, {"found 400 496e30d3", "place 400 56d5cd3c", "rotation 400 aa318c81", "doubt 400 4ec8190c",
                      "met 400 cb96584c"});
}

}  // namespace
}  // namespace fencepost::recon
