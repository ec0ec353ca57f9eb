#include "firmware/recon/models/hybrid/hybrid.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/recon/models/hybrid/hybrid_solver.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"
#include "tests/firmware/recon/exact_view.hpp"
#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using namespace recon;

// The sizes that robots run: another profile is another test.
using Wide = Hybrid<config::Small::kHybridSectors>;
using WideSolver = HybridSolver<config::Small::kHybridSectors, config::Small::kHybridOrder>;
static_assert(config::Full::kHybridSectors == config::Small::kHybridSectors);
static_assert(config::Full::kHybridOrder == config::Small::kHybridOrder);
using Narrow = Hybrid<config::Micro::kHybridSectors>;
using NarrowSolver = HybridSolver<config::Micro::kHybridSectors, config::Micro::kHybridOrder>;

constexpr double kPi = std::numbers::pi;

host::LinearRing box(double width, double depth, host::Point center = {0, 0}, double turn = 0) {
  host::LinearRing ring;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double a = x * width / 2, b = y * depth / 2;
    ring.push_back(
        {center.x + a * std::cos(turn) - b * std::sin(turn), center.y + a * std::sin(turn) + b * std::cos(turn)});
  }
  return ring;
}

std::vector<host::Point> circle(host::Point center, double radius, int views, double start = 0.3) {
  std::vector<host::Point> lenses;
  for (int i = 0; i < views; ++i) {
    const double angle = start + 2 * kPi * i / views;
    lenses.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return lenses;
}

template <class HybridType, class Solver>
struct Filter {
  HybridType hybrid;
  Solver solver;
  bool begun = false;

  void see(const Sighting& sighting) {
    if (!begun) hybrid.begin(sighting);
    begun = true;
    hybrid.add(sighting, {});
    if (hybrid.new_weight) solver.solve(hybrid);
  }
  void see(const host::LinearRing& footprint, const std::vector<host::Point>& lenses) {
    for (const host::Point& lens : lenses) see(view_of(footprint, lens).sighting);
  }
};
using WideFilter = Filter<Wide, WideSolver>;
using NarrowFilter = Filter<Narrow, NarrowSolver>;

/// Support value of the fitted outline in the map frame.
template <class HybridType>
double support(const HybridType& hybrid, std::size_t k) {
  const Vec2 direction = node_direction(k, hybrid.offsets.size());
  const double x = hybrid.origin.x / 1e5, y = hybrid.origin.y / 1e5;
  return static_cast<double>(hybrid.outline().offset(k)) + static_cast<double>(direction.x()) * x +
         static_cast<double>(direction.y()) * y;
}
double support(const host::LinearRing& footprint, std::size_t k, std::size_t nodes) {
  const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(nodes);
  double most = -1e9;
  for (const host::Point& p : footprint) most = std::max(most, p.x * std::cos(angle) + p.y * std::sin(angle));
  return most;
}
template <class HybridType>
double worst_offset(const HybridType& hybrid, const host::LinearRing& footprint) {
  double worst = 0;
  const std::size_t nodes = hybrid.offsets.size();
  for (std::size_t k = 0; k < nodes; ++k) {
    worst = std::max(worst, std::abs(support(hybrid, k) - support(footprint, k, nodes)));
  }
  return worst;
}

template <class HybridType>
void expect_same(const HybridType& a, const HybridType& b) {
  EXPECT_EQ(a.origin, b.origin);
  EXPECT_EQ(a.last_lens, b.last_lens);
  EXPECT_EQ(a.views, b.views);
  EXPECT_EQ(a.used, b.used);
  EXPECT_EQ(a.spread, b.spread);
  EXPECT_EQ(a.refusal, b.refusal);
  EXPECT_EQ(a.new_weight, b.new_weight);
  EXPECT_EQ(a.fitting, b.fitting);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.sigmas, b.sigmas);
  for (std::size_t i = 0; i < a.clusters.size(); ++i) {
    const PackedCluster& one = a.clusters[i];
    const PackedCluster& other = b.clusters[i];
    ASSERT_EQ(one.views, other.views) << i;
    if (one.views == 0) continue;
    EXPECT_EQ(one.offset_low, other.offset_low) << i;
    EXPECT_EQ(one.offset_high, other.offset_high) << i;
    EXPECT_EQ(one.phase, other.phase) << i;
    EXPECT_EQ(one.sigma, other.sigma) << i;
  }
}

TEST(Hybrid, HasNothingToSayBeforeItIsFitted) {
  Wide hybrid;
  hybrid.begin(view_of(box(0.2, 0.1), {1, 0}).sighting);
  EXPECT_EQ(hybrid.refusal, HybridRefusal::kNoTangents);
  EXPECT_FALSE(name(hybrid.refusal).empty());
}

TEST(Hybrid, FindsABoxFromExactEdges) {
  const host::LinearRing footprint = box(0.20, 0.12, {0.4, -0.3}, 0.35);
  WideFilter filter;
  filter.see(footprint, circle({0.4, -0.3}, 0.9, 48));
  ASSERT_TRUE(filter.hybrid.ok());
  EXPECT_LT(worst_offset(filter.hybrid, footprint), 4e-3);
  EXPECT_GT(filter.hybrid.outline().confidence(), 0.75F);
  NarrowFilter narrow;  // corners are beyond a series of order 4
  narrow.see(footprint, circle({0.4, -0.3}, 0.9, 48));
  ASSERT_TRUE(narrow.hybrid.ok());
  EXPECT_LT(worst_offset(narrow.hybrid, footprint), 9e-3);
}

TEST(Hybrid, FindsACylinderToAMillimetre) {
  WideFilter filter;
  for (const host::Point& lens : circle({0, 0}, 0.8, 24)) filter.see(view_of_circle({0, 0}, 0.07, lens).sighting);
  for (std::size_t k = 0; k < 64; ++k) EXPECT_NEAR(support(filter.hybrid, k), 0.07, 1e-3) << k;
}

// The outline as a polygon: of an exact box it is the box, a corner rounded by half a node's step at most.
TEST(Hybrid, PolygonIsTheOutline) {
  const host::LinearRing footprint = box(0.20, 0.12);
  WideFilter filter;
  filter.see(footprint, circle({0, 0}, 0.9, 48));
  std::array<Vec2, kOutlineVertices> vertices;
  const std::size_t size = outline_polygon(filter.hybrid.outline(), 0, vertices);
  ASSERT_GE(size, 4U);
  double twice = 0;
  for (std::size_t i = 0; i < size; ++i) twice += static_cast<double>(cross(vertices[i], vertices[(i + 1) % size]));
  EXPECT_NEAR(twice / 2, 0.20 * 0.12, 0.0012);
  const std::size_t wider = outline_polygon(filter.hybrid.outline(), 2, vertices);
  double wider_twice = 0;
  for (std::size_t i = 0; i < wider; ++i) {
    wider_twice += static_cast<double>(cross(vertices[i], vertices[(i + 1) % wider]));
  }
  EXPECT_GT(wider_twice, twice);
}

TEST(Hybrid, DistanceIsThatToTheOutline) {
  WideFilter filter;
  filter.see(box(0.20, 0.12), circle({0, 0}, 0.9, 48));
  const Vec2 middle{static_cast<float>(filter.hybrid.origin.x) * 1e-5F,
                    static_cast<float>(filter.hybrid.origin.y) * 1e-5F};
  std::size_t nearest = 99;
  EXPECT_NEAR(filter.hybrid.outline().distance_from(Vec2{1, 0} - middle, nearest), 0.9F, 3e-3F);
  EXPECT_EQ(nearest, 0U);
  EXPECT_NEAR(filter.hybrid.outline().distance_from(Vec2{0, -0.5F} - middle, nearest), 0.44F, 3e-3F);
  EXPECT_EQ(nearest, 48U);
  const float corner = std::hypot(0.9F, 0.94F);
  EXPECT_NEAR(filter.hybrid.outline().distance_from(Vec2{1, 1} - middle, nearest), corner, 5e-3F);
  EXPECT_LT(filter.hybrid.outline().distance_from(-middle, nearest), -0.05F);
}

// Whatever the processor does side by side, the first of several sides that are equally far off is found. They are
// looked at a quarter turn apart.
template <std::size_t kNodes>
void expect_first_side(std::mt19937& random) {
  std::array<std::int16_t, kNodes> offsets{};
  std::array<std::uint8_t, kNodes> sigmas{};
  const int spread = 1 << random() % 15;
  for (std::int16_t& offset : offsets) offset = static_cast<std::int16_t>(static_cast<int>(random() % 65'535) % spread);
  const OutlineView outline{offsets, sigmas};
  const auto coordinate = [&] { return (static_cast<float>(random() % 20'001) - 10'000.0F) * 6e-4F; };
  const Vec2 point = random() % 8 == 0 ? Vec2{0, 0} : Vec2{coordinate(), coordinate()};
  const WholeVector at{static_cast<std::int32_t>(point.x() * (1 / kOffsetStep)),
                       static_cast<std::int32_t>(point.y() * (1 / kOffsetStep))};
  std::size_t expected = 0;
  std::int32_t most = std::numeric_limits<std::int32_t>::min();
  for (std::size_t i = 0; i < kNodes; ++i) {
    const std::size_t k = i % 4 * (kNodes / 4) + i / 4;
    const WholeVector direction = whole_direction(k, kNodes);
    const std::int32_t outside = direction.x * at.x + direction.y * at.y - offsets[k] * kWholeUnit;
    if (outside <= most) continue;
    most = outside;
    expected = k;
  }
  std::size_t nearest = 99;
  const float distance = outline.distance_from(point, nearest);
  ASSERT_EQ(nearest, expected) << point.x() << " " << point.y();
  ASSERT_EQ(distance, node_direction(nearest, kNodes).dot(point) - outline.offset(nearest));
}
TEST(OutlineView, DistanceIsFromTheFirstSideThatIsFarthestOff) {
  std::mt19937 random(71);
  for (int i = 0; i < 20'000; ++i) {
    expect_first_side<64>(random);
    expect_first_side<32>(random);
  }
}

// Moved by whole steps of the map, everything is the same but the origin: bit for bit.
TEST(HybridProperties, MovesWithTheScene) {
  const host::LinearRing footprint = box(0.20, 0.12, {0, 0}, 0.2);
  WideFilter here, there;
  constexpr MapPoint kShift{1'234'560, -987'650};
  for (const host::Point& lens : circle({0, 0}, 0.9, 20)) {
    Sighting sighting = view_of(footprint, lens).sighting;
    here.see(sighting);
    sighting.anchor = kShift;
    there.see(sighting);
  }
  here.hybrid.origin = {here.hybrid.origin.x + kShift.x, here.hybrid.origin.y + kShift.y};
  expect_same(here.hybrid, there.hybrid);
}

// Turned by any angle the tangents fall into other sectors; the outline stays the same to a few millimetres.
TEST(HybridProperties, TurnsWithTheScene) {
  for (const double turn : {0.1, 0.8, kPi / 2, 2.9}) {
    const host::LinearRing footprint = box(0.20, 0.12, {0, 0}, turn);
    WideFilter filter;
    filter.see(footprint, circle({0, 0}, 0.9, 48, 0.3 + turn));
    EXPECT_LT(worst_offset(filter.hybrid, footprint), 4.5e-3) << turn;
  }
}

TEST(HybridProperties, IsMirroredWithTheScene) {
  const host::LinearRing footprint = box(0.20, 0.12, {0.02, 0.05}, 0.4);
  host::LinearRing mirrored;
  for (const host::Point& p : footprint) mirrored.insert(mirrored.begin(), {p.x, -p.y});
  WideFilter filter, mirror;
  for (const host::Point& lens : circle({0, 0}, 0.9, 30)) {
    filter.see(view_of(footprint, lens).sighting);
    mirror.see(view_of(mirrored, {lens.x, -lens.y}).sighting);
  }
  for (std::size_t k = 0; k < 64; ++k) {
    EXPECT_NEAR(support(filter.hybrid, k), support(mirror.hybrid, (64 - k) % 64), 2e-3) << k;
  }
}

// The paper's carving can never give back what a bad segment cut away. This does.
TEST(HybridProperties, AWrongViewIsForgivenAfterGoodOnes) {
  const host::LinearRing footprint = box(0.20, 0.16);
  const std::vector<host::Point> lenses = circle({0, 0}, 0.9, 40);
  WideFilter filter;
  filter.see(footprint, {lenses.begin(), lenses.begin() + 8});
  host::LinearRing half = footprint;  // the left half of the segment is lost
  for (host::Point& p : half) p.y = std::min(p.y, 0.0);
  filter.see(half, {lenses.begin() + 8, lenses.begin() + 10});
  filter.see(footprint, {lenses.begin() + 10, lenses.end()});
  EXPECT_LT(worst_offset(filter.hybrid, footprint), 6e-3);
  WideFilter fooled;  // if all of them say so, it is so
  fooled.see(half, lenses);
  EXPECT_GT(worst_offset(fooled.hybrid, footprint), 0.05);
}

TEST(HybridProperties, AParkedRobotAddsNothing) {
  WideFilter filter;
  const host::LinearRing footprint = box(0.20, 0.12);
  filter.see(footprint, circle({0, 0}, 0.9, 10));
  const Wide before = filter.hybrid;
  const host::Point last = circle({0, 0}, 0.9, 10).back();
  std::mt19937 random(5);
  std::normal_distribution<double> jitter(0, 0.001);
  for (int i = 0; i < 100; ++i) {  // a millimetre is no new information at 0.9 m
    filter.see(view_of(footprint, {last.x + jitter(random), last.y + jitter(random)}).sighting);
  }
  expect_same(filter.hybrid, before);
}

// A fit notes at its end whether the outline is known well, which alerts go by.
TEST(HybridProperties, NotesWhetherItsOutlineIsKnownWell) {
  WideFilter filter;
  int known_well = 0;
  for (const host::Point& lens : circle({0, 0}, 0.9, 40)) {
    filter.see(view_of(box(0.20, 0.12), lens).sighting);
    EXPECT_EQ(filter.hybrid.known_well, filter.hybrid.outline().known_well());
    known_well += filter.hybrid.known_well ? 1 : 0;
  }
  EXPECT_GT(known_well, 0);
  EXPECT_LT(known_well, 40);
}

TEST(HybridProperties, AParkedRobotTakesWhatItTurnsTo) {
  const host::LinearRing footprint = box(0.20, 0.12);
  Sighting half = view_of(footprint, {1, 0}).sighting;
  half.left.end = recon::End::kLowerBound;
  WideFilter filter;
  filter.see(half);
  EXPECT_EQ(filter.hybrid.used, ViewTangents::kRight | ViewTangents::kLeft << ViewTangents::kBits);
  filter.see(half);
  EXPECT_FALSE(filter.hybrid.new_weight);
  filter.see(view_of(footprint, {1, 0}).sighting);
  EXPECT_EQ(filter.hybrid.used & (ViewTangents::kRight | ViewTangents::kLeft),
            ViewTangents::kRight | ViewTangents::kLeft);
  EXPECT_EQ(filter.hybrid.views, 1);
}

/// A box of 0.2 m by 0.12 m, approached in 60 views. Its right end is at y = 0.06, but only the part below y = 0.04 is
/// seen. `mistaken`: one view sees only the part below y = 0, and takes that end for an edge.
Wide approached(recon::End end, bool mistaken) {
  WideFilter filter;
  for (int i = 0; i < 60; ++i) {
    const bool wrong = mistaken && i == 5;
    host::LinearRing seen = box(0.20, 0.12);
    for (host::Point& p : seen) p.y = std::min(p.y, wrong ? 0.0 : 0.04);
    Sighting sighting = view_of(seen, {1.5 - 0.01 * i, 0.3 - 0.01 * i}).sighting;
    sighting.right.end = wrong ? recon::End::kSeen : end;
    filter.see(sighting);
  }
  return filter.hybrid;
}
constexpr std::size_t kUp = 16;  // of 64 directions: +y

// An object that goes on behind something is no smaller than its seen part. Another object's end says nothing of this
// one.
TEST(HybridProperties, AHiddenEndSaysHowFarItReachesAtLeast) {
  EXPECT_NEAR(support(approached(recon::End::kSeen, false), kUp), 0.04, 0.006);
  EXPECT_GT(support(approached(recon::End::kLowerBound, false), kUp), 0.036);
}
TEST(HybridProperties, AHiddenEndContradictsASmallerEdge) {
  EXPECT_LT(support(approached(recon::End::kOccluded, true), kUp), 0.025);
  EXPECT_GT(support(approached(recon::End::kLowerBound, true), kUp), 0.035);
}

TEST(HybridProperties, CensoredEndsAddNothing) {
  Sighting blind = view_of(box(0.20, 0.12), {1, 0}).sighting;
  blind.left.end = blind.right.end = recon::End::kLowerBound;
  WideFilter filter;
  filter.see(blind);
  EXPECT_FALSE(filter.hybrid.ok());
  for (const PackedCluster& cluster : filter.hybrid.clusters) EXPECT_EQ(cluster.views, 0);
}

// Steps or all at once, 64 sectors or 32: the same bits, and no step is much longer than it may be.
TEST(HybridSolver, SlicingGivesTheSameBits) {
  const host::LinearRing footprint = box(0.20, 0.12, {0, 0}, 0.3);
  WideFilter at_once;
  Wide sliced;
  WideSolver solver;
  std::size_t steps = 0;
  bool first = true;
  for (const host::Point& lens : circle({0, 0}, 0.9, 30)) {
    const Sighting sighting = view_of(footprint, lens).sighting;
    at_once.see(sighting);
    if (first) sliced.begin(sighting);
    first = false;
    sliced.add(sighting, {});
    solver.begin(sliced);
    for (steps = 1; !solver.step(sliced); ++steps) {
    }
  }
  expect_same(at_once.hybrid, sliced);
  EXPECT_GT(steps, 50U);
}

// Alerts read outline and sigmas between two steps: never a half of each.
template <class FilterType>
void expect_nothing_in_place_before_it_is_done() {
  const host::LinearRing footprint = box(0.20, 0.12);
  const std::vector<host::Point> lenses = circle({0, 0}, 0.9, 30);
  FilterType filter;
  filter.see(footprint, {lenses.begin(), lenses.begin() + 12});
  const auto before = filter.hybrid;
  filter.hybrid.add(view_of(footprint, lenses[20]).sighting, {});
  filter.solver.begin(filter.hybrid);
  int steps = 0;
  while (!filter.solver.step(filter.hybrid)) {
    ++steps;
    EXPECT_TRUE(filter.hybrid.fitting);
    EXPECT_EQ(filter.hybrid.offsets, before.offsets);
    EXPECT_EQ(filter.hybrid.sigmas, before.sigmas);
  }
  EXPECT_GT(steps, 5);
  EXPECT_FALSE(filter.hybrid.fitting);
  EXPECT_NE(filter.hybrid.offsets, before.offsets);
  EXPECT_NE(filter.hybrid.sigmas, before.sigmas);
}
TEST(HybridSolver, PutsNothingInPlaceBeforeItIsDone) { expect_nothing_in_place_before_it_is_done<WideFilter>(); }
TEST(HybridSolver, PutsNothingInPlaceBeforeItIsDoneInMicro) {
  expect_nothing_in_place_before_it_is_done<NarrowFilter>();
}

// A warm fit begins from the outline of all views but the last two, with the last passes alone. It takes a third of
// the steps to the same outline within a tenth of its size. The eighth fit is a whole one again, to the same bits.
template <class FilterType>
void expect_warm_fits_follow_whole_ones(double most_off) {
  const host::LinearRing footprint = box(0.20, 0.12);
  const std::vector<host::Point> lenses = circle({0, 0}, 0.9, 32);
  FilterType filter;
  filter.see(footprint, {lenses.begin(), lenses.begin() + 30});
  filter.hybrid.add(view_of(footprint, lenses[30]).sighting, {});
  filter.hybrid.add(view_of(footprint, lenses[31]).sighting, {});
  const auto with_new_view = filter.hybrid;
  const auto steps_of = [&](auto& hybrid, bool warm) {
    warm ? filter.solver.begin_warm(hybrid) : filter.solver.begin(hybrid);
    EXPECT_TRUE(hybrid.fitting);
    EXPECT_EQ(hybrid.new_weight, 0);
    int steps = 1;
    while (!filter.solver.step(hybrid)) ++steps;
    return steps;
  };
  auto whole = with_new_view;
  auto warm = with_new_view;
  const int steps = steps_of(whole, false);
  EXPECT_LT(steps_of(warm, true), steps / 2);
  EXPECT_EQ(warm.warm_fits, 1);
  EXPECT_NE(warm.offsets, with_new_view.offsets);
  EXPECT_LT(worst_offset(whole, footprint), most_off);
  EXPECT_LT(worst_offset(warm, footprint), most_off);

  auto eighth = with_new_view;
  eighth.warm_fits = kWholeFitEvery - 1;
  EXPECT_EQ(steps_of(eighth, true), steps);
  EXPECT_EQ(eighth.warm_fits, 0);
  expect_same(eighth, whole);
}
TEST(HybridSolver, GoesOnFromTheOutlineThatIsThere) { expect_warm_fits_follow_whole_ones<WideFilter>(0.01); }
TEST(HybridSolver, GoesOnFromTheOutlineThatIsThereInMicro) { expect_warm_fits_follow_whole_ones<NarrowFilter>(0.02); }

// While views are few the outline is of another kind: there is nothing to go on from.
TEST(HybridSolver, BeginsFromNothingWhileViewsAreFew) {
  const host::LinearRing footprint = box(0.20, 0.12);
  const std::vector<host::Point> lenses = circle({0, 0}, 0.9, 30);
  WideFilter filter;
  filter.see(footprint, {lenses.begin(), lenses.begin() + kViewsForPolygon - 1});
  filter.solver.begin_warm(filter.hybrid);
  EXPECT_EQ(filter.hybrid.warm_fits, 0);
}

// A view from somewhere else counts whole, one from a third of a whole view's way in part; a fit has them all.
TEST(Hybrid, CountsNewViewsByTheirWeight) {
  const host::LinearRing footprint = box(0.20, 0.12);
  WideFilter filter;
  filter.see(footprint, circle({0, 0}, 0.9, 12));
  EXPECT_EQ(filter.hybrid.new_weight, 0);
  // From the last of the circle, at 0.3 - 30 degrees.
  const double last = 0.3 - kPi / 6;
  const double part = 0.35 * static_cast<double>(kNovelShare);
  const auto lens = [&](double turn) { return host::Point{0.9 * std::cos(last + turn), 0.9 * std::sin(last + turn)}; };
  filter.hybrid.add(view_of(footprint, lens(part)).sighting, {});
  EXPECT_NEAR(filter.hybrid.new_weight, 0.35 * kWholeView, 2);
  filter.hybrid.add(view_of(footprint, lens(2 * part)).sighting, {});
  EXPECT_NEAR(filter.hybrid.new_weight, 0.7 * kWholeView, 3);
  filter.hybrid.add(view_of(footprint, lens(2)).sighting, {});
  EXPECT_NEAR(filter.hybrid.new_weight, 1.7 * kWholeView, 3);
}

// Wild tangents, thousands of them: every number stays finite and in range.
TEST(HybridSolver, SurvivesNonsense) {
  std::mt19937 random(99);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int run = 0; run < 20; ++run) {
    WideFilter wide;
    NarrowFilter narrow;
    for (int i = 0; i < 60; ++i) {
      const double bearing = 7 * any(random);
      Sighting s =
          view_between({2 * any(random), 2 * any(random)}, bearing, bearing + 0.7 * (1 + any(random))).sighting;
      if (any(random) > 0.7) s.left.end = recon::End::kLowerBound;
      if (any(random) > 0.7) s.right.end = recon::End::kLowerBound;
      s.rows_known = any(random) > 0;
      s.bottom = {static_cast<float>(0.1 + 0.3 * (1 + any(random))),
                  any(random) > 0.5 ? recon::End::kLowerBound : recon::End::kSeen};
      wide.see(s);
      narrow.see(s);
    }
    for (const std::int16_t offset : wide.hybrid.offsets) EXPECT_LE(std::abs(offset), kFarthestOffset);
    const float confidence = wide.hybrid.outline().confidence();
    EXPECT_TRUE(confidence >= 0 && confidence <= 1) << confidence;
    std::array<Vec2, kOutlineVertices> vertices;
    const std::size_t size = outline_polygon(wide.hybrid.outline(), 0, vertices);
    for (std::size_t i = 0; i < size; ++i)
      EXPECT_TRUE(std::isfinite(vertices[i].x()) && std::isfinite(vertices[i].y()));
    EXPECT_TRUE(narrow.hybrid.outline().confidence() >= 0);
  }
}

/// From `lens`, looking at the origin's neighbourhood: its edges along directions that need no trigonometry.
Sighting lattice_sighting(Draw& draw) {
  const Vec2 side = draw.of<Vec2>({{1, 0}, {0.6F, 0.8F}, {0.6F, -0.8F}, {0, 1}, {-0.8F, 0.6F}, {-1, 0}, {0, -1}});
  const auto end = [&] {
    return draw.of({End::kSeen, End::kSeen, End::kSeen, End::kAmbiguous, End::kLowerBound, End::kOccluded});
  };
  Sighting sighting;
  sighting.axis = draw.one_in(4) ? rotated(side, {0.96F, 0.28F}) : side;
  sighting.center = side;
  sighting.lens = -draw.of({1.0F, 1.0F, 1.25F, 0.5F, 0.03125F}) * side;
  const Vec2 narrow{0.9921875F, 0.125F}, wide{0.96F, 0.28F};
  const Vec2 left = draw.coin() ? narrow : wide, right = draw.coin() ? narrow : wide;
  sighting.left = {rotated(side, left), end()};
  sighting.right = {rotated(side, {right.x(), -right.y()}), end()};
  sighting.focal = 256;
  sighting.lens_height = 0.125F;
  sighting.rows_known = !draw.one_in(4);
  sighting.bottom = {draw.of({0.125F, 0.15625F, 0.25F, 0.0F}), end()};
  sighting.known_radius = draw.one_in(4) ? 0.125F : 0.0F;
  return sighting;
}

template <class HybridType, class Solver>
void tell_hybrid(Draw& draw, Sweep& sweep) {
  const auto hybrid = std::make_unique<HybridType>();
  const auto solver = std::make_unique<Solver>();
  for (int look = 0; look < 14; ++look) {
    const Sighting sighting = lattice_sighting(draw);
    if (look == 0) hybrid->begin(sighting);
    hybrid->add(sighting, {});
    sweep.tell("new weight", hybrid->new_weight);
    sweep.tell("guess", guessed_middle(sighting).x() + 4 * guessed_middle(sighting).y());
    if (hybrid->new_weight && !draw.one_in(3)) solver->solve(*hybrid);
    for (std::size_t part = 0; part < HybridType::kHashParts; ++part) {
      base::Fnv1a64 hash;
      hybrid->hash(hash, part);
      sweep.tell("digest", static_cast<std::uint32_t>(hash.value()));
    }
    sweep.tell("refusal", static_cast<int>(hybrid->refusal));
    const Vec2 from{draw.steps(-8, 8, 0.25F), draw.steps(-8, 8, 0.25F)};
    const Vec2 normal = draw.of<Vec2>({{1, 0}, {0, 1}, {0.6F, 0.8F}, {-0.8F, 0.6F}, {0, -1}});
    sweep.tell("contradict", hybrid->edges_contradict(from, normal));
    if (!hybrid->ok()) continue;
    const OutlineView outline = hybrid->outline();
    sweep.tell("confidence", outline.confidence());
    std::size_t nearest = 0;
    sweep.tell("distance", outline.distance_from(draw.of({1.0F, 4.0F}) * from, nearest));
    sweep.tell("nearest", nearest);
    const Chord chord = outline.chord_at(draw.steps(-8, 8, 0.03125F));
    sweep.tell("chord", chord.low + 8 * chord.high);
    std::array<Vec2, kOutlineVertices> vertices;
    const std::size_t size = outline_polygon(outline, draw.of({0.0F, 1.0F, 3.0F}), vertices);
    sweep.tell("vertices", size);
    for (std::size_t i = 0; i < size; ++i) sweep.tell("vertex", vertices[i].x() + 4 * vertices[i].y());
  }
}

// All that an outline keeps and reports, after views from a lattice of places with all kinds of ends.
TEST(Hybrid, OfViewsFromALattice) {
  Draw draw(151);
  Sweep sweep;
  for (int run = 0; run < 30; ++run) {
    tell_hybrid<Wide, WideSolver>(draw, sweep);
    tell_hybrid<Narrow, NarrowSolver>(draw, sweep);
  }
  expect_said(sweep, {"new weight 763 97360354", "guess 840 35a0506e", "digest 1680 56fa5dc6", "refusal 48 17b22957",
                      "contradict 342 9c9ca453", "confidence 703 e8540e0a", "distance 792 9a85dfd2",
                      "nearest 771 78266c2f", "chord 792 747af8cd", "vertices 790 18a808e8", "vertex 27400 f8e079a1"});
}

// An outline whose every side is the same share of itself uncertain: how far it is moved out.
TEST(Hybrid, IsMovedOutByShare) {
  Sweep sweep;
  for (int i = 0; i < 240; ++i) sweep.tell("inflation", inflation(static_cast<float>(i) * 0.05F));
  expect_said(sweep, {"inflation 240 8c0c1629"});
}

}  // namespace
}  // namespace fencepost::test
