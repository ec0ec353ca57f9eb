#include "firmware/recon/models/cylinder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/firmware/recon/exact_view.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::Cylinder;
using recon::CylinderRefusal;
using recon::Vec2;

constexpr host::Point kCenter{1.0, 0.0};
constexpr double kRadius = 0.06;

void add(Cylinder& cylinder, const recon::Sighting& sighting, float novelty = 1) {
  cylinder.add(sighting, {0, 0}, novelty, {});
  cylinder.solve(sighting.lens_from({0, 0}), sighting.center, {});
}

// The bottom row of an object that stands on the floor, as its nearest point shows it.
void stand_on_floor(recon::Sighting& sighting, double nearest_depth) {
  sighting.rows_known = true;
  sighting.bottom = {static_cast<float>(static_cast<double>(sighting.lens_height) / nearest_depth), recon::End::kSeen};
}

TEST(Cylinder, RefusesUntilThereIsParallax) {
  Cylinder cylinder;
  EXPECT_EQ(cylinder.estimate().refusal, CylinderRefusal::kNoEdges);
  // Ten views from nearly one place: the distance stays unknown.
  for (int i = 0; i < 10; ++i) {
    add(cylinder, view_of_circle(kCenter, kRadius, {0, 0.001 * i}).sighting);
    EXPECT_EQ(cylinder.estimate().refusal, CylinderRefusal::kParallax) << i;
  }
  for (int i = 0; i < 10; ++i) add(cylinder, view_of_circle(kCenter, kRadius, {0, 0.05 * i}).sighting);
  EXPECT_TRUE(cylinder.estimate().ok());
}

// One look is enough for a thing of known width; parallax overrules a width that is wrong.
TEST(Cylinder, IsAtOnceWhereAKnownWidthPutsIt) {
  Cylinder cylinder;
  recon::Sighting first = view_of_circle(kCenter, kRadius, {0, 0}).sighting;
  first.known_radius = static_cast<float>(kRadius);
  add(cylinder, first);
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_NEAR(cylinder.estimate().center.x(), kCenter.x, 0.005);
  EXPECT_NEAR(cylinder.estimate().radius, kRadius, 0.001);
  EXPECT_NEAR(recon::prior_distance(first), kCenter.x, 0.005);
  Cylinder misled;
  for (int i = 0; i < 200; ++i) {
    recon::Sighting sighting = view_of_circle(kCenter, kRadius, {0, 0.005 * i}).sighting;
    sighting.known_radius = static_cast<float>(1.3 * kRadius);
    add(misled, sighting);
    if (i == 0) {
      EXPECT_GT(misled.estimate().center.x(), 1.2);
    }
  }
  EXPECT_NEAR(misled.estimate().center.x(), kCenter.x, 0.03);
  EXPECT_LT(misled.estimate().radius, 1.15 * kRadius);
}

TEST(Cylinder, CensoredEndsAddNothing) {
  Cylinder cylinder;
  for (int i = 0; i < 10; ++i) {
    recon::Sighting s = view_of_circle(kCenter, kRadius, {0, 0.1 * i}).sighting;
    s.left.end = s.right.end = recon::End::kLowerBound;
    add(cylinder, s);
  }
  EXPECT_EQ(cylinder.estimate().refusal, CylinderRefusal::kNoEdges);
}

TEST(Cylinder, IsKnownWholeAfterFiveViewsInARowWithBothEnds) {
  Cylinder cylinder;
  const auto look = [&](bool whole) {
    recon::Sighting s = view_of_circle(kCenter, kRadius, {0, 0}).sighting;
    if (!whole) s.right.end = recon::End::kLowerBound;
    add(cylinder, s);
  };
  for (int i = 0; i < 100; ++i) look(i % 5 != 4);  // a wall, of which noise takes an end
  EXPECT_FALSE(cylinder.known_whole());
  for (int i = 0; i < 4; ++i) look(true);
  EXPECT_FALSE(cylinder.known_whole());
  look(true);
  EXPECT_TRUE(cylinder.known_whole());
  look(false);
  EXPECT_TRUE(cylinder.known_whole()) << "the robot has come near";
}

TEST(Cylinder, IsNeverBehindTheLensThatSeesIt) {
  Cylinder cylinder;
  for (int i = 0; i < 20; ++i) add(cylinder, view_of_circle(kCenter, kRadius, {0, 0.05 * i}).sighting);
  ASSERT_TRUE(cylinder.estimate().ok());
  cylinder.solve({0, 0}, {-1, 0}, {});
  EXPECT_EQ(cylinder.estimate().refusal, CylinderRefusal::kImplausible);
  cylinder.solve({0, 0}, {1, 0}, {});
  EXPECT_TRUE(cylinder.estimate().ok());
}

TEST(Cylinder, ApproachingStraightIsEnoughWhenTheIntervalGrows) {
  Cylinder cylinder;
  for (int i = 0; i < 20; ++i) add(cylinder, view_of_circle(kCenter, kRadius, {0.04 * i, 0}).sighting);
  ASSERT_TRUE(cylinder.estimate().ok()) << name(cylinder.estimate().refusal);
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().radius, 0.06F, 1e-3F);
}

TEST(Cylinder, OneViewIsEnoughWithTheGroundRow) {
  recon::Sighting s = view_of_circle(kCenter, kRadius, {0, 0}).sighting;
  stand_on_floor(s, 1.0 - kRadius);
  Cylinder cylinder;
  add(cylinder, s);
  ASSERT_TRUE(cylinder.estimate().ok()) << name(cylinder.estimate().refusal);
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().center.y(), 0.0F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().radius, 0.06F, 2e-3F);
}

TEST(Cylinder, TheFootOfABlobThatTheBorderCutsPlacesItToARadius) {
  std::array<double, 2> sigmas{};
  for (const bool cut : {false, true}) {
    Cylinder cylinder;
    for (int i = 0; i < 3; ++i) {
      recon::Sighting s = view_of_circle(kCenter, kRadius, {0.02 * i, 0}).sighting;
      s.right.end = recon::End::kLowerBound;
      s.cut_at_side = cut;
      stand_on_floor(s, 1.0 - kRadius - 0.02 * i);
      add(cylinder, s);
    }
    ASSERT_TRUE(cylinder.estimate().ok()) << name(cylinder.estimate().refusal);
    EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 0.05F) << cut;
    sigmas[cut ? 1 : 0] = std::sqrt(static_cast<double>(cylinder.estimate().covariance.along({-1, 0})));
  }
  EXPECT_GT(sigmas[1], 1.5 * sigmas[0]);
  EXPECT_LT(sigmas[1], kRadius);
}

// A neighbour hides one end all the time: an object of the usual size stands there.
TEST(Cylinder, OneEdgeAndTheGroundRowMakeOneOfTheUsualSize) {
  Cylinder cylinder;
  for (int i = 0; i < 3; ++i) {
    recon::Sighting s = view_of_circle(kCenter, kRadius, {0.02 * i, 0}).sighting;
    s.right.end = recon::End::kLowerBound;
    stand_on_floor(s, 1.0 - kRadius - 0.02 * i);
    add(cylinder, s);
  }
  ASSERT_TRUE(cylinder.estimate().ok()) << name(cylinder.estimate().refusal);
  EXPECT_NEAR(cylinder.estimate().radius, 0.08F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.02F, 5e-3F);   // its front is where the row is
  EXPECT_NEAR(cylinder.estimate().center.y(), -0.02F, 5e-3F);  // its left edge is where the edge is
}

// Headings that are off by half a degree look like parallax on a straight approach, and draw the edges' distance in.
// The rows know better.
TEST(Cylinder, ANoisyApproachDoesNotOverruleTheRows) {
  std::mt19937 random(1);
  Cylinder cylinder;
  for (int i = 0; i < 60; ++i) {
    const host::Point lens{-0.9 + 0.025 * i, 0.1};
    recon::Sighting s = view_of_circle(kCenter, kRadius, lens).sighting;
    double sum = 0;  // of twelve uniform numbers: nearly normal, variance 1
    for (int n = 0; n < 12; ++n) sum += static_cast<double>(random()) / 4294967296.0;
    const Vec2 off = unit(0.009 * (sum - 6));
    for (Vec2* direction : {&s.left.direction, &s.right.direction, &s.axis, &s.center}) {
      *direction = recon::rotated(off, *direction);
    }
    stand_on_floor(s, 1.0 - lens.x - kRadius);
    add(cylinder, s);
    if (i < 5) continue;
    ASSERT_TRUE(cylinder.estimate().ok()) << i << name(cylinder.estimate().refusal);
    const float front = cylinder.estimate().center.x() - cylinder.estimate().radius;
    EXPECT_NEAR(front, 0.94F, 0.1F * (0.94F - static_cast<float>(lens.x))) << i;
  }
}

// A box on a shelf: its bottom row lies. Once the edges know better, the row is dropped.
TEST(Cylinder, RowsOfAnObjectAboveTheFloorAreDropped) {
  Cylinder cylinder;
  for (const host::Point& lens : arc(kCenter, 1.0, 40)) {
    recon::Sighting s = view_of_circle(kCenter, kRadius, lens).sighting;
    stand_on_floor(s, 1.7 * (1.0 - kRadius));  // 5 cm up, seen from 12 cm
    add(cylinder, s);
  }
  EXPECT_TRUE(cylinder.rows_beyond_edges());
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().center.y(), 0.0F, 2e-3F);
  EXPECT_NEAR(cylinder.estimate().radius, 0.06F, 2e-3F);
}

// On the way to a post, its rows may be those of a foot on the floor or of a thing that comes nearer.
TEST(Cylinder, RowsAreBeyondTheEdgesOfAThingThatComes) {
  struct Case {
    const char* what;
    double comes;  // m, while the robot drives one
    double base;   // as a share of the lens's height
    double drives;
    bool beyond;
  };
  for (const Case& c :
       {Case{"on the floor", 0, 0, 1, false}, Case{"comes", 1, 0, 1, true}, Case{"comes slowly", 0.4, 0, 1, true},
        Case{"recedes", -0.5, 0, 1, false}, Case{"seen from one place", 0, 0.4, 0, false}}) {
    SCOPED_TRACE(c.what);
    Cylinder cylinder;
    EXPECT_FALSE(cylinder.rows_beyond_edges());
    for (int i = 0; i < 36; ++i) {
      const double driven = 0.03 * i;
      const host::Point center{2.2 - c.comes * driven, 0.4};
      const host::Point lens{c.drives * driven, 0};
      recon::Sighting s = view_of_circle(center, kRadius, lens).sighting;
      s.axis = unit(0);
      stand_on_floor(s, (center.x - kRadius - lens.x) / (1 - c.base));
      add(cylinder, s);
    }
    EXPECT_EQ(cylinder.rows_beyond_edges(), c.beyond);
    EXPECT_EQ(cylinder.rows_put_farther(), c.beyond);
  }
}

// After a short way noise may have feigned what the edges say. It is said all the same, and taken back.
TEST(Cylinder, RowsPutAThingFartherBeforeTheEdgesSurelyKnow) {
  Cylinder cylinder;
  const auto see = [&](double driven, double comes) {
    const host::Point center{2.2 - comes * driven, 0.4};
    recon::Sighting s = view_of_circle(center, kRadius, {driven, 0}).sighting;
    s.axis = unit(0);
    stand_on_floor(s, center.x - kRadius - driven);
    add(cylinder, s);
    return cylinder.rows_put_farther();
  };
  EXPECT_FALSE(see(0, 1));
  int early = 0;
  for (int i = 1; i < 36 && !cylinder.rows_beyond_edges(); ++i) early += see(0.03 * i, 1) ? 1 : 0;
  EXPECT_GT(early, 1);
  EXPECT_TRUE(cylinder.rows_beyond_edges());
}

// Rows read with a wrong pitch move the estimate, but not the circle of the edges.
TEST(Cylinder, WhatTheEdgesSayKnowsNoRows) {
  Cylinder cylinder, without;
  recon::Sighting last;
  for (int i = 0; i < 8; ++i) {
    last = view_of_circle(kCenter, kRadius, {0, 0.05 * i}).sighting;
    add(without, last);
    stand_on_floor(last, 1.15 * (kCenter.x - kRadius));
    add(cylinder, last);
  }
  const recon::CylinderEstimate by_edges = cylinder.by_edges(last.lens_from({0, 0}));
  ASSERT_TRUE(by_edges.ok());
  EXPECT_NEAR(by_edges.center.x(), kCenter.x, 0.03);
  EXPECT_GT(cylinder.estimate().center.x(), kCenter.x + 0.06);
  EXPECT_EQ(without.by_edges(last.lens_from({0, 0})).center, without.estimate().center);
}

TEST(Cylinder, OneWrongViewInTenIsOutvoted) {
  Cylinder cylinder;
  int i = 0;
  for (const host::Point& lens : arc(kCenter, 1.0, 60)) {
    recon::Sighting s = view_of_circle(kCenter, kRadius, lens).sighting;
    if (++i % 10 == 0) {  // half the segment is lost on the left
      s.left.direction = s.axis;
    }
    add(cylinder, s);
  }
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 4e-3F);
  EXPECT_NEAR(cylinder.estimate().center.y(), 0.0F, 4e-3F);
  EXPECT_NEAR(cylinder.estimate().radius, 0.06F, 4e-3F);
}

TEST(Cylinder, RecoversAfterTheObjectWasMoved) {
  Cylinder cylinder;
  for (const host::Point& lens : arc(kCenter, 1.0, 60)) {
    add(cylinder, view_of_circle(kCenter, kRadius, lens).sighting);
  }
  const host::Point there{1.3, 0.2};
  for (int round = 0; round < 3; ++round) {
    for (const host::Point& lens : arc(kCenter, 1.0, 60)) {
      add(cylinder, view_of_circle(there, kRadius, lens).sighting);
    }
  }
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.3F, 2e-2F);
  EXPECT_NEAR(cylinder.estimate().center.y(), 0.2F, 2e-2F);
}

TEST(Cylinder, CovarianceShrinksWithViewsAndPointsAlongTheRay) {
  Cylinder few;
  Cylinder many;
  int i = 0;
  for (const host::Point& lens : arc({1.0, 0.0}, 1.0, 80)) {
    const recon::Sighting s = view_of_circle(kCenter, kRadius, lens).sighting;
    if (i < 6) add(few, s);
    if (i < 60) add(many, s);
    ++i;
  }
  ASSERT_TRUE(few.estimate().ok());
  EXPECT_GT(few.estimate().outline_sigma(), 3 * many.estimate().outline_sigma());
  const Vec2 lens = unit(0.3);  // the first views all look from there to the centre
  EXPECT_GT(few.estimate().covariance.position_along(lens),
            10 * few.estimate().covariance.position_along(recon::left_of(lens)));
}

TEST(Cylinder, MovingTheOriginChangesNothing) {
  Cylinder here;
  Cylinder moved_origin;
  const Vec2 shift{0.7F, -0.4F};
  int i = 0;
  for (const host::Point& lens : arc(kCenter, 1.0, 20)) {
    const recon::Sighting s = view_of_circle(kCenter, kRadius, lens).sighting;
    add(here, s);
    add(moved_origin, s);
    if (++i == 10) break;
  }
  moved_origin.move_origin(shift);
  const Vec2 bearing = view_of_circle(kCenter, kRadius, {0, 0}).sighting.center;
  moved_origin.solve(Vec2{0, 0} - shift, bearing, {});
  here.solve({0, 0}, bearing, {});
  ASSERT_TRUE(here.estimate().ok());
  EXPECT_NEAR(moved_origin.estimate().center.x() + shift.x(), here.estimate().center.x(), 1e-5F);
  EXPECT_NEAR(moved_origin.estimate().center.y() + shift.y(), here.estimate().center.y(), 1e-5F);
  EXPECT_NEAR(moved_origin.estimate().radius, here.estimate().radius, 1e-5F);
}

// Ten thousand views: the information is bounded, the estimate still follows.
TEST(Cylinder, StaysExactOverThousandsOfViews) {
  Cylinder cylinder;
  const auto lenses = arc(kCenter, 1.0, 100);
  for (int round = 0; round < 100; ++round) {
    for (const host::Point& lens : lenses) add(cylinder, view_of_circle(kCenter, kRadius, lens).sighting);
  }
  ASSERT_TRUE(cylinder.estimate().ok());
  EXPECT_NEAR(cylinder.estimate().center.x(), 1.0F, 1e-3F);
  EXPECT_NEAR(cylinder.estimate().radius, 0.06F, 1e-3F);
}

// Views from a lattice of places, of an object that is there or not, with feet that fit or not. The whole state of the
// estimator is compared after each of them.
TEST(Cylinder, OfViewsFromALattice) {
  Draw draw(161);
  Sweep sweep;
  for (int run = 0; run < 300; ++run) {
    recon::Cylinder cylinder;
    const float known = draw.one_in(3) ? 0.28F : 0.0F;
    for (int look = 0; look < 12; ++look) {
      const recon::Vec2 side =
          draw.of<recon::Vec2>({{1, 0}, {1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}, {0, 1}, {0.8F, 0.6F}});
      const float away = draw.of({1.0F, 1.0F, 1.25F, 2.0F, 0.03125F});
      const auto end = [&] {
        return draw.of({recon::End::kSeen, recon::End::kSeen, recon::End::kAmbiguous, recon::End::kLowerBound});
      };
      recon::Sighting sighting;
      sighting.axis = draw.one_in(3) ? recon::rotated(side, {0.96F, 0.28F}) : side;
      sighting.center = side;
      sighting.lens = -away * side;
      if (draw.one_in(6)) sighting.lens += recon::Vec2{draw.steps(-2, 2, 0.125F), draw.steps(-2, 2, 0.125F)};
      sighting.left = {recon::rotated(side, {0.96F, 0.28F}), end()};
      sighting.right = {recon::rotated(side, {0.96F, -0.28F}), end()};
      sighting.focal = 256;
      sighting.known_radius = known;
      sighting.lens_height = 0.125F;
      sighting.rows_known = run % 2 == 0;
      sighting.bottom = {0.125F / (away * draw.of({0.75F, 0.75F, 1.0F, 2.0F})), end()};
      sweep.tell("prior", recon::prior_distance(sighting));
      cylinder.add(sighting, {}, draw.of({1.0F, 1.0F, 0.5F, 0.05F}), {});
      if (!draw.one_in(4)) cylinder.solve(sighting.lens, side, {});
      if (draw.one_in(12)) cylinder.move_origin({0.125F, -0.25F});
      base::Fnv1a64 hash;
      cylinder.hash(hash);
      sweep.tell("digest", static_cast<std::uint32_t>(hash.value()));
      sweep.tell("refusal", static_cast<int>(cylinder.estimate().refusal));
      sweep.tell("whole", cylinder.known_whole());
      sweep.tell("rows", cylinder.row_count());
      if (cylinder.estimate().ok()) sweep.tell("sigma", cylinder.estimate().outline_sigma());
    }
  }
  for (int run = 0; run < 100; ++run) {
    recon::Cylinder point;
    for (int look = 0; look < 12; ++look) {
      recon::Sighting sighting;
      sighting.axis = sighting.center =
          draw.of<recon::Vec2>({{1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}, {0, 1}, {0.8F, 0.6F}});
      sighting.lens = -draw.of({1.0F, 1.25F, 2.0F}) * sighting.axis;
      if (draw.one_in(6)) sighting.lens += recon::Vec2{draw.steps(-2, 2, 0.125F), draw.steps(-2, 2, 0.125F)};
      sighting.bearing = true;
      sighting.focal = 256;
      point.add(sighting, {}, draw.of({1.0F, 0.5F}), {});
      point.solve(sighting.lens, sighting.axis, {});
      base::Fnv1a64 hash;
      point.hash(hash);
      sweep.tell("bearings", static_cast<std::uint32_t>(hash.value()));
    }
  }
  expect_said(sweep, {"prior 3600 1b9f8997", "digest 3600 1667d316", "refusal 745 969ab905", "whole 401 11075e9d",
                      "rows 1778 a416d5d7", "sigma 2855 2558e8e8", "bearings 1200 22157584"});
}

}  // namespace
}  // namespace fencepost::test
