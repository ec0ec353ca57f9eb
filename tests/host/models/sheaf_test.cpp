// Alg. 2 in parts: two rays, a partner, a store, a hull.
#include "host/models/sheaf.hpp"

#include <gtest/gtest.h>

#include <array>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/track/object.hpp"
#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "tests/firmware/recon/exact_view.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::SheafPlane;
using recon::SheafRefusal;
using recon::SheafView;
using recon::Vec2;

constexpr double kDegree = std::numbers::pi / 180;

// A view from `lens` whose centre is at `bearing` degrees and whose edges are `half` degrees to either side.
SheafView view_at(Vec2 lens, double bearing, double half = 3) {
  return {lens, unit(bearing * kDegree), unit((bearing + half) * kDegree), unit((bearing - half) * kDegree)};
}

// From (0, 0) the edges are seen along (1, 2)/sqrt 5 and (3, 4)/5, from (1, 0) along (-3, 4)/5 and (-1, 2)/sqrt 5.
//   left:  a (1, 2) = (1, 0) + b (-3, 4)  =>  2 a = 4 b, a = 1 - 3 b  =>  b = 0.2, a = 0.4. The post is (0.4, 0.8).
//   right: a (3, 4) = (1, 0) + b (-1, 2)  =>  4 a = 2 b, 3 a = 1 - b  =>  a = 0.2, b = 0.4. The post is (0.6, 0.8).
SheafView first_view() { return {{0, 0}, {0.52574F, 0.85065F}, Vec2{1, 2}.normalized(), {0.6F, 0.8F}}; }
SheafView second_view() { return {{1, 0}, {-0.52574F, 0.85065F}, {-0.6F, 0.8F}, Vec2{-1, 2}.normalized()}; }

TEST(SheafPlane, JoinsThePostsOfAHandWorkedPair) {
  for (const auto& [a, b] : {std::pair{first_view(), second_view()}, std::pair{second_view(), first_view()}}) {
    const SheafPlane plane = recon::sheaf_plane(a, b, recon::kPaperLeastSine);
    ASSERT_TRUE(plane.whole());
    EXPECT_LT((plane.left - Vec2{0.4F, 0.8F}).norm(), 1e-6F);
    EXPECT_LT((plane.right - Vec2{0.6F, 0.8F}).norm(), 1e-6F);
  }
}

TEST(SheafPlane, CensoredEndsNeverTriangulate) {
  recon::Sighting sighting;
  sighting.left = {Vec2{1, 2}.normalized(), recon::End::kLowerBound};
  sighting.right = {{0.6F, 0.8F}, recon::End::kSeen};
  const SheafView one_end = recon::sheaf_view(sighting, {});
  EXPECT_EQ(one_end.true_ends(), 1);
  const SheafPlane plane = recon::sheaf_plane(one_end, second_view(), recon::kPaperLeastSine);
  EXPECT_FALSE(plane.has_left);
  EXPECT_TRUE(plane.has_right);
  EXPECT_TRUE(plane.any());
  EXPECT_FALSE(plane.whole());
}

// Two rays 0.1 m apart that lean together by `angle` degrees meet at 0.1 / tan(angle) m.
bool meets(double angle, float least_sine) {
  const SheafView straight{{0, 0}, {0, 1}, {0, 1}, {0, 0}};
  const SheafView leaning{{0.1F, 0}, {0, 1}, unit((90 + angle) * kDegree), {0, 0}};
  return recon::sheaf_plane(straight, leaning, least_sine).has_left;
}
TEST(SheafPlane, NearlyParallelRaysDoNotMeet) {
  EXPECT_TRUE(meets(5.01, recon::kPaperLeastSine));
  EXPECT_FALSE(meets(4.99, recon::kPaperLeastSine));
  EXPECT_FALSE(meets(0, recon::kPaperLeastSine));
  EXPECT_TRUE(meets(4.99, recon::kSheafLeastSine));
  EXPECT_FALSE(meets(0.49, recon::kSheafLeastSine));
  EXPECT_TRUE(meets(1.45, recon::kSheafLeastSine));   // at 3.95 m
  EXPECT_FALSE(meets(1.42, recon::kSheafLeastSine));  // at 4.03 m: farther than kPostFarthest
}
TEST(SheafPlane, RaysDoNotMeetBehindOrInALens) {
  EXPECT_FALSE(meets(-20, recon::kPaperLeastSine));
  // From (0.1, 0) straight left: meets the first ray in its own lens, from (0.1, 0.03) 3 cm before it.
  const SheafView straight{{0, 0}, {0, 1}, {0, 1}, {0, 0}};
  const SheafView level{{0.1F, 0}, {-1, 0}, {-1, 0}, {0, 0}};
  const SheafView higher{{0.1F, 0.03F}, {-1, 0}, {-1, 0}, {0, 0}};
  EXPECT_FALSE(recon::sheaf_plane(straight, level, recon::kPaperLeastSine).any());
  EXPECT_TRUE(recon::sheaf_plane(straight, higher, recon::kPaperLeastSine).any());
}

TEST(SheafPartner, IsNearestToFifteenDegreesAndRatherALaterView) {
  const auto at = [](double bearing) { return view_at({0, 0}, bearing); };
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(5), at(13), at(18), at(30)}, 0), 2U);
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(-17)}, 0), 1U);
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(0.9)}, 0), 2U);         // too near
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(1.1)}, 0), 1U);         // near enough
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(59)}, 0), 1U);          // far enough
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(60.1)}, 0), 2U);        // too far
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(15), at(29)}, 1), 2U);  // earlier is better by 1 deg: not enough
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(0), at(15), at(25)}, 1), 0U);  // better by 5 deg
  EXPECT_EQ(recon::sheaf_partner(std::vector{at(350), at(5), at(8)}, 1), 0U);  // over the end of the circle
  SheafView right_only = at(15);
  right_only.left = {0, 0};
  SheafView left_only = at(0);
  left_only.right = {0, 0};
  EXPECT_EQ(recon::sheaf_partner(std::vector{left_only, right_only}, 0), 2U);  // no end in common
  EXPECT_EQ(recon::sheaf_partner(std::vector{left_only, right_only, at(50)}, 0), 2U);
}

TEST(PlaneSheaf, SaysWhyItIsEmpty) {
  recon::PlaneSheaf<8, 16> sheaf;
  const auto both = [&](const std::vector<SheafView>& views) {
    sheaf.build(views);
    const SheafRefusal refusal = sheaf.refusal();
    EXPECT_TRUE(sheaf.hull().empty());
    sheaf.build_paper(views);
    EXPECT_TRUE(sheaf.hull().empty());
    EXPECT_EQ(refusal, sheaf.refusal());
    return name(refusal);
  };
  EXPECT_EQ(both({}), "only censored ends seen");
  EXPECT_EQ(both({view_at({0, -1}, 90)}), "no edges of two views cross");
  EXPECT_EQ(both({view_at({0, -1}, 90), view_at({0, -1}, 90.5)}), "no edges of two views cross");
  EXPECT_EQ(both({view_at({0, -1}, 90), view_at({0.2F, -1}, 102)}), "fewer than three posts");
  // One ray, and three others from one lens that cross it: all posts are on it.
  const SheafView left_only{{0, -1}, {0, 1}, {0, 1}, {0, 0}};
  std::vector<SheafView> fan{left_only};
  for (const double bearing : {110, 120, 130})
    fan.push_back({{0.2F, -1}, unit(bearing * kDegree), unit(bearing * kDegree), {0, 0}});
  sheaf.build_paper(fan);
  EXPECT_EQ(sheaf.posts(), 3U);
  EXPECT_EQ(name(sheaf.refusal()), "all posts on one line");
  EXPECT_TRUE(sheaf.hull().empty());
}

// Eight posts 0.1 m from the middle at 22.5, 67.5, ... degrees, and four on one line through it at 0.249 and 0.251 m.
// The middle two of the twelve x are -0.1 sin(22.5 deg) and 0.1 sin(22.5 deg), of the radii 0.1 and 0.1. So the medians
// are 0 and 0.1, and 2.5 x 0.1 = 0.25 lies between the far ones. The same in every direction of the axis.
TEST(PlaneSheaf, PostsFarFromTheOthersAreTrimmed) {
  for (const double turn : {0.0, 31.0, 200.0}) {
    const auto post = [&](double radius, double angle) -> Vec2 {
      return static_cast<float>(radius) * unit((angle + turn) * kDegree) + Vec2{0.5F, -0.25F};
    };
    std::vector<SheafPlane> planes;
    for (const double angle : {22.5, 67.5, 112.5, 157.5}) {
      planes.push_back({post(0.1, angle), post(0.1, angle + 180), true, true});
    }
    planes.push_back({post(0.249, 0), post(0.251, 0), true, true});
    planes.push_back({post(0.251, 180), post(0.249, 180), true, true});
    planes.push_back({{90, 90}, {90, 90}, false, false});
    std::vector<float> scratch(2 * planes.size());
    recon::trim_posts(planes, unit(turn * kDegree), scratch);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(planes[i].whole()) << i;
    EXPECT_TRUE(planes[4].has_left);
    EXPECT_FALSE(planes[4].has_right);
    EXPECT_FALSE(planes[5].has_left);
    EXPECT_TRUE(planes[5].has_right);
    EXPECT_FALSE(planes[6].any());
  }
}

TEST(PlaneSheaf, AmongFivePostsNoneIsWild) {
  std::vector<SheafPlane> few{
      {{0, 0}, {1, 0}, true, true}, {{0, 1}, {90, 0}, true, true}, {{1, 1}, {0, 0}, true, false}};
  std::vector<float> scratch(6);
  recon::trim_posts(few, {1, 0}, scratch);
  EXPECT_TRUE(few[1].whole());
  few.push_back({{0, 2}, {0, 0}, true, false});
  scratch.resize(8);
  recon::trim_posts(few, {1, 0}, scratch);
  EXPECT_TRUE(few[1].has_left);
  EXPECT_FALSE(few[1].has_right);
}

// ---- the store

recon::Sighting sighting_at(double bearing, recon::End left = recon::End::kSeen) {
  recon::Sighting sighting;
  sighting.lens = -1.0F * unit(bearing * kDegree);
  sighting.center = unit(bearing * kDegree);
  sighting.left = {unit((bearing + 3) * kDegree), left};
  sighting.right = {unit((bearing - 3) * kDegree), recon::End::kSeen};
  return sighting;
}

double degrees_between(const SheafView& a, const SheafView& b) {
  const double half_chord = std::min(1.0, static_cast<double>((a.bearing - b.bearing).norm()) / 2);
  return 2 * std::asin(half_chord) / kDegree;
}

// The models that a robot lacks cost it no byte.
TEST(SheafViews, MicroPaysNothing) {
  struct Without : recon::ObjectCore {
    recon::Hybrid<config::Micro::kHybridSectors> hybrid;
  };
  static_assert(sizeof(recon::Object<config::Micro>) == sizeof(Without));
}

TEST(SheafViews, AParkedRobotFillsTwoPlaces) {
  recon::SheafViews<24> store;
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) store.add(sighting_at(40 + 0.5 * static_cast<double>(random()) / 4294967296.0), {});
  EXPECT_EQ(store.view().size(), 2U);
}

TEST(SheafViews, BlindViewsAreNotKeptAndHalfOnesDoNotPushWholeOnesOut) {
  recon::SheafViews<24> store;
  recon::Sighting blind = sighting_at(0);
  blind.left.end = blind.right.end = recon::End::kLowerBound;
  store.add(blind, {});
  EXPECT_TRUE(store.view().empty());
  for (const double bearing : {0.0, 20.0, 20.1}) store.add(sighting_at(bearing), {});
  store.add(sighting_at(20.2, recon::End::kLowerBound),
            {});  // the robot turns on the spot, the object leaves the image
  ASSERT_EQ(store.view().size(), 3U);
  EXPECT_EQ(store.view()[2].true_ends(), 2);

  store.start({}, {});
  for (int i = 0; i < 24; ++i) store.add(sighting_at(15 * i, i == 7 ? recon::End::kLowerBound : recon::End::kSeen), {});
  std::array<float, recon::kThinningColumns * recon::thinning_room(24)> columns{};
  std::size_t known = 0;
  const std::size_t goes = recon::view_to_give_up(store.view(), view_at({0, 0}, 7), {columns, known});
  EXPECT_EQ(goes, 7U);
}

TEST(SheafViews, MoveWithTheOrigin) {
  recon::SheafViews<8> store;
  store.add(sighting_at(0), {});
  store.move_origin({0.25F, -0.5F});
  EXPECT_EQ(store.view()[0].lens, (Vec2{-1.25F, 0.5F}));
}

// Round the object twice in small steps, then back: the store keeps the newest view and always has a partner for it.
template <std::size_t N>
double worst_partner(double step) {
  recon::SheafViews<N> store;
  double worst = 0;
  double travelled = 0;
  double bearing = 0;
  const auto drive = [&](double degrees, double by) {
    for (double done = 0; done < degrees; done += std::abs(by)) {
      bearing += by;
      travelled += std::abs(by);
      store.add(sighting_at(bearing), {});
      const SheafView& newest = store.view().back();
      EXPECT_LT(degrees_between(newest, view_at({0, 0}, bearing)), 0.01);
      if (travelled < 15 + step) continue;
      double best = 180;
      for (const SheafView& view : store.view()) best = std::min(best, std::abs(degrees_between(view, newest) - 15));
      worst = std::max(worst, best);
    }
  };
  drive(720, step);
  EXPECT_EQ(store.view().size(), N);
  drive(400, -step);
  std::printf("  store of %zu views, %.2f deg a frame: the best partner is %.1f deg from 15 deg at worst\n", N, step,
              worst);
  return worst;
}
TEST(SheafViews, HoldAPartnerNearFifteenDegrees) {
  for (const double step : {0.2, 1.3, 3.0}) EXPECT_LT(worst_partner<75>(step), 3.5);
  for (const double step : {0.1, 1.3, 3.0}) EXPECT_LT(worst_partner<36>(step), 7.5);
}

// ---- the hull

struct GrownHull {
  std::vector<Vec2> vertices;
  std::size_t size = 0;
  explicit GrownHull(std::size_t capacity) : vertices(capacity + 1) {}
  void add(const Vec2& point) { size = recon::grow_hull(vertices, size, point); }
  [[nodiscard]] host::LinearRing ring() const {
    host::LinearRing ring;
    for (std::size_t i = 0; i < size; ++i) {
      ring.push_back({static_cast<double>(vertices[i].x()), static_cast<double>(vertices[i].y())});
    }
    return ring;
  }
};

TEST(GrowHull, GrowsFromAPointToALineToAPolygon) {
  GrownHull hull(8);
  const auto size_with = [&](Vec2 point) {
    hull.add(point);
    return hull.size;
  };
  EXPECT_EQ(size_with({0, 0}), 1U);
  EXPECT_EQ(size_with({0, 0}), 1U);
  EXPECT_EQ(size_with({1, 0}), 2U);
  EXPECT_EQ(size_with({0.5F, 0}), 2U);
  EXPECT_EQ(size_with({2, 0}), 2U);
  EXPECT_EQ(size_with({-1, 0}), 2U);
  EXPECT_EQ(size_with({0, -1}), 3U);
  EXPECT_NEAR(host::area({hull.ring(), {}}), 1.5, 1e-6);
  EXPECT_GT(host::signed_area(hull.ring()), 0);
  EXPECT_EQ(size_with({0, 1}), 4U);
  EXPECT_EQ(size_with({0.1F, 0.1F}), 4U);  // inside
  EXPECT_EQ(size_with({1, 0.5F}), 4U);     // on an edge
  EXPECT_EQ(size_with({-5, 0}), 4U);       // (-1, 0) goes
  EXPECT_EQ(size_with({-5, -9}), 4U);      // (0, -1) goes
  EXPECT_EQ(size_with({20, 30}), 4U);      // (2, 0) and (0, 1): one stays
}

// Points in random clouds, rings and rows against the hull in double.
double fuzz_hull(unsigned seed, std::size_t capacity) {
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) { return a + (b - a) * (static_cast<double>(random()) / 4294967295.0); };
  double worst = 0;
  for (int round = 0; round < 200; ++round) {
    GrownHull hull(capacity);
    host::LinearRing points;
    const double radius = uniform(0.02, 0.3);
    for (int i = 0; i < 200; ++i) {
      const double angle = round % 3 == 0 ? 0.05 * std::floor(uniform(0, 126)) : uniform(0, 2 * std::numbers::pi);
      const double r = round % 2 == 0 ? radius : radius * uniform(0, 1);
      const Vec2 point = static_cast<float>(r) * unit(angle) + Vec2{0.5F, -0.2F};
      hull.add(point);
      points.push_back({static_cast<double>(point.x()), static_cast<double>(point.y())});
    }
    EXPECT_LE(hull.size, capacity);
    const host::LinearRing ring = hull.ring();
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const host::Point& a = ring[i];
      const host::Point& b = ring[(i + 1) % ring.size()];
      const host::Point& c = ring[(i + 2) % ring.size()];
      EXPECT_GT((b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x), -1e-8);
    }
    for (const host::Point& p : points) {
      if (!host::contains({ring, {}}, p)) worst = std::max(worst, host::distance_to_outline(p, ring) / radius);
    }
    EXPECT_FALSE(host::find_invalidity({ring, {}}).has_value());
  }
  return worst;
}
TEST(GrowHull, HoldsAllPointsWithRoomEnough) { EXPECT_LT(fuzz_hull(5, 192), 1e-4); }
TEST(GrowHull, GivesUpLittleAtTheBound) {
  const double at_24 = fuzz_hull(6, 24);
  const double at_8 = fuzz_hull(7, 8);
  std::printf("  hull of 24 vertices loses %.4f of the radius at most, of 8 vertices %.4f\n", at_24, at_8);
  EXPECT_LT(at_24, 0.05);
  EXPECT_LT(at_8, 0.3);
  EXPECT_GT(at_8, at_24);
}

// Area of the hull by Andrew's monotone chain, in double.
double hull_area(std::vector<host::Point> points) {
  std::sort(points.begin(), points.end(),
            [](const host::Point& a, const host::Point& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto chain = [&](auto begin, auto end) {
    host::LinearRing ring;
    for (auto p = begin; p != end; ++p) {
      const auto turns_right = [&](const host::Point& a, const host::Point& b) {
        return (b.x - a.x) * (p->y - b.y) - (b.y - a.y) * (p->x - b.x) <= 0;
      };
      while (ring.size() >= 2 && turns_right(ring[ring.size() - 2], ring.back())) ring.pop_back();
      ring.push_back(*p);
    }
    return ring;
  };
  host::LinearRing hull = chain(points.begin(), points.end());
  const host::LinearRing upper = chain(points.rbegin(), points.rend());
  hull.insert(hull.end(), upper.begin() + 1, upper.end() - 1);
  return host::signed_area(hull);
}

// All posts of one view lie on its ray, so whole fans of them are on one line but for rounding. That is the sheaf's own
// way to go wrong. Noisy rays at one place, all pairs that cross at 5 degrees or more.
TEST(GrowHull, HoldsFansOfPostsOnOneRay) {
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0.0F, 0.03F);
  double worst = 0;
  for (int tour = 0; tour < 100; ++tour) {
    std::vector<recon::SheafView> views;
    for (int i = 0; i < 75; ++i) {
      const double angle = 2 * std::numbers::pi * i / 75;
      const Vec2 toward = -unit(angle);
      recon::SheafView view{-1.0F * toward, toward};
      view.left = unit(angle + std::numbers::pi + static_cast<double>(noise(random)) + 0.05);
      view.right = unit(angle + std::numbers::pi + static_cast<double>(noise(random)) - 0.05);
      views.push_back(view);
    }
    GrownHull hull(192);
    std::vector<host::Point> posts;
    recon::for_each_paper_plane(views, [&](const recon::SheafPlane& plane) {
      for (const bool left : {true, false}) {
        if (!(left ? plane.has_left : plane.has_right)) continue;
        const Vec2& post = left ? plane.left : plane.right;
        hull.add(post);
        posts.push_back({static_cast<double>(post.x()), static_cast<double>(post.y())});
      }
    });
    const double area = hull_area(posts);
    ASSERT_GT(area, 0.1);
    worst = std::max(worst, std::abs(host::signed_area(hull.ring()) - area) / area);
  }
  EXPECT_LT(worst, 1e-4);
}

// Bounds as they stand in the header, met exactly: rays along the axes and along (0.8, 0.6), whose sine is 0.6.
TEST(SheafPlane, RaysMeetAtTheLeastSineAndAtTheNearestPost) {
  const auto posts = [](const SheafView& a, const SheafView& b, float sine) {
    const SheafPlane plane = recon::sheaf_plane(a, b, sine);
    return 2 * plane.has_left + plane.has_right;
  };
  const SheafView along{{0, 0}, {1, 0}, {1, 0}, {0, 0}};
  const SheafView across{{0, -1}, {0.8F, 0.6F}, {0.8F, 0.6F}, {0.8F, 0.6F}};
  EXPECT_EQ(posts(along, across, 0.6F), 2);
  EXPECT_EQ(posts(across, along, 0.6F), 2);
  EXPECT_EQ(posts(along, across, std::nextafter(0.6F, 1.0F)), 0);
  constexpr float kNear = recon::kPostNearest;
  for (const float at : {kNear, std::nextafter(kNear, 0.0F)}) {
    const SheafView up{{at, -1}, {0, 1}, {0, 1}, {0, 0}};
    EXPECT_EQ(posts(along, up, 0.5F), at == kNear ? 2 : 0);
    EXPECT_EQ(posts(up, along, 0.5F), at == kNear ? 2 : 0);
  }
  for (const float at : {recon::kPostFarthest, std::nextafter(recon::kPostFarthest, 0.0F)}) {
    EXPECT_EQ(posts(along, {{at, -1}, {0, 1}, {0, 1}, {0, 0}}, 0.5F), at < recon::kPostFarthest ? 2 : 0);
  }
}

// Bearings that are not unit, so that chords are exactly the bounds.
TEST(SheafPartner, OfChordsThatAreTheBounds) {
  Draw draw(81);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<SheafView> views(static_cast<std::size_t>(draw.between(1, 5)));
    for (SheafView& view : views) {
      constexpr float kMin = recon::kParallaxLeast, kWanted = recon::kParallaxWanted;
      view.bearing = {1, draw.of({0.0F, kMin, std::nextafter(kMin, 1.0F), kWanted, kWanted + kMin, 2 * kWanted,
                                  kWanted - kMin, recon::kParallaxMost, std::nextafter(recon::kParallaxMost, 0.0F)})};
      if (draw.one_in(4)) view.bearing.y() = -view.bearing.y();
      if (!draw.one_in(3)) view.left = view.bearing;
      if (!draw.one_in(3)) view.right = view.bearing;
    }
    for (std::size_t j = 0; j < views.size(); ++j) {
      sweep.tell("partner", recon::sheaf_partner(views, j));
      sweep.tell("repeats", recon::repeats(views[0], views[j]));
      sweep.tell("ends", views[j].true_ends());
    }
  }
  expect_said(sweep, {"partner 48809 d3207cae", "repeats 24126 d5ed6843", "ends 53158 06320f9a"});
}

// Points of a square lattice: on edges, on their lines, on corners; and steps as small as the tolerance.
TEST(GrowHull, OfPointsOnItsEdgesAndTheirLines) {
  constexpr float u = recon::kHullTolerance;
  Draw draw(82);
  Sweep sweep;
  for (int run = 0; run < 1'500; ++run) {
    const float step = run % 3 == 0 ? u : 0.25F;
    std::array<Vec2, 9> hull;
    const std::size_t room = draw.of<std::size_t>({6, 9});
    std::size_t size = 0;
    for (int i = 0; i < 14; ++i) {
      const int reach = run % 2 == 0 ? 2 : 4;
      Vec2 point{draw.steps(-reach, reach, step), draw.steps(-reach, reach, run % 5 == 0 ? u : step)};
      if (i < 3 && run % 3 == 0) point = {i == 1 ? 1.0F : 0.0F, 0};
      size = recon::grow_hull(std::span(hull).first(room), size, point);
      sweep.tell("size", size);
      for (std::size_t j = 0; j < size; ++j) {
        sweep.tell("x", hull[j].x());
        sweep.tell("y", hull[j].y());
      }
    }
  }
  expect_said(sweep, {"size 21000 d24126c5", "x 72419 c4bbc522", "y 66370 26a61533"});
}

// Radii of 1 and 2.5 around posts that are their own median: on the axes nothing is rounded.
TEST(PlaneSheaf, TrimsBeyondItsRadii) {
  Draw draw(83);
  Sweep sweep;
  for (int run = 0; run < 3'000; ++run) {
    std::array<SheafPlane, 6> planes{};
    for (SheafPlane& plane : planes) {
      const auto post = [&] {
        const float along = draw.of({1.0F, -1.0F, 1.0F, -1.0F, 2.5F, -2.5F, 2.25F, 2.75F});
        return draw.coin() ? Vec2{along, 0} : Vec2{0, along};
      };
      plane.left = post();
      plane.right = post();
      plane.has_left = !draw.one_in(3);
      plane.has_right = !draw.one_in(3);
    }
    std::array<float, 12> scratch{};
    const Vec2 axis = draw.of<Vec2>({{1, 0}, {0, -1}, {0.6F, 0.8F}});
    recon::trim_posts(std::span(planes).first(draw.between<std::size_t>(3, 6)), axis, scratch);
    for (const SheafPlane& plane : planes) sweep.tell("posts", 2 * plane.has_left + plane.has_right);
  }
  expect_said(sweep, {"posts 15777 56e5b2dd"});
}

// Views of a lattice of posts from a lattice of places: all that a sheaf tells of them.
TEST(PlaneSheaf, OfViewsFromALattice) {
  Draw draw(84);
  Sweep sweep;
  const auto sheaf = std::make_unique<recon::PlaneSheaf<12, 24>>();
  const auto store = std::make_unique<recon::SheafViews<8>>();
  for (int run = 0; run < 300; ++run) {
    store->start({}, {});
    for (int i = draw.between(0, 12); i > 0; --i) {
      const int half = draw.between(-8, 8);
      const Vec2 lens{draw.of({-1.0F, 0.0F, 1.0F}), static_cast<float>(half) / 8 - 2};
      recon::Sighting sighting;
      sighting.lens = lens;
      sighting.center = -lens.normalized();
      const auto edge = [&](const Vec2& at) -> recon::Ray {
        const Vec2 away = at - lens;
        return {away.normalized(),
                draw.one_in(4) ? recon::End::kLowerBound : draw.of({recon::End::kSeen, recon::End::kAmbiguous})};
      };
      sighting.left = edge({-0.125F, draw.of({0.0F, 0.125F})});
      sighting.right = edge({0.125F, draw.of({0.0F, 0.125F})});
      store->add(sighting, {});
      sweep.tell("views", store->view().size());
    }
    if (draw.one_in(4)) store->move_origin({0.25F, -0.5F});
    const auto tell_sheaf = [&] {
      sweep.tell("refusal", static_cast<int>(sheaf->refusal()));
      sweep.tell("posts", sheaf->posts());
      for (const Vec2& post : sheaf->hull()) sweep.tell("hull", post.x() + 4 * post.y());
    };
    sheaf->build(store->view());
    tell_sheaf();
    sweep.tell("planes", sheaf->planes().size());
    sheaf->build_paper(store->view());
    tell_sheaf();
  }
  expect_said(sweep, {"views 1746 7b3552eb", "refusal 232 c111cad9", "posts 456 637db78b", "hull 1665 fc7f9d27",
                      "planes 229 98bf58a3"});
}

}  // namespace
}  // namespace fencepost::test
