// Alg. 2 as a whole, against the same rules in double and with all views remembered.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <random>

#include "firmware/config/profile.hpp"
#include "firmware/recon/track/object.hpp"
#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "host/models/sheaf.hpp"
#include "host/replay/compared.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using host::LinearRing;
using host::Point;

constexpr Point kCenter{1.05, 0.05};
constexpr double kDegree = std::numbers::pi / 180;
enum class Rule { kPaper, kTrimmed };
constexpr Rule kRules[] = {Rule::kPaper, Rule::kTrimmed};

const char* name(Rule rule) { return rule == Rule::kPaper ? "sheaf_paper" : "sheaf"; }

// ---- the oracle: map frame, angles, no bound

struct OracleView {
  Point lens;
  double left;
  double right;
  [[nodiscard]] double middle() const { return (left + right) / 2; }
};

double chord(double angle) { return 2 * std::abs(std::sin(angle / 2)); }

void add_post(LinearRing& posts, Point p, double a, Point q, double b, double least) {
  const double sine = std::sin(b - a);
  if (std::abs(sine) < std::sin(least)) return;
  const Point r{q.x - p.x, q.y - p.y};
  const double t = (r.x * std::sin(b) - r.y * std::cos(b)) / sine;
  const double s = (r.x * std::sin(a) - r.y * std::cos(a)) / sine;
  if (t < 0.02 || s < 0.02) return;
  const Point post{p.x + t * std::cos(a), p.y + t * std::sin(a)};
  if (std::hypot(post.x - kCenter.x, post.y - kCenter.y) < 4) posts.push_back(post);
}

void add_pair(LinearRing& posts, const OracleView& a, const OracleView& b, double least) {
  add_post(posts, a.lens, a.left, b.lens, b.left, least);
  add_post(posts, a.lens, a.right, b.lens, b.right, least);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 != 0 ? values[half] : (values[half - 1] + values[half]) / 2;
}

LinearRing trimmed(const LinearRing& posts, double axis) {
  if (posts.size() < 6) return posts;
  std::vector<double> along;
  std::vector<double> across;
  for (const Point& p : posts) {
    along.push_back(p.x * std::cos(axis) + p.y * std::sin(axis));
    across.push_back(p.y * std::cos(axis) - p.x * std::sin(axis));
  }
  const double x = median(along);
  const double y = median(across);
  std::vector<double> radii;
  for (std::size_t i = 0; i < posts.size(); ++i) radii.push_back(std::hypot(along[i] - x, across[i] - y));
  const double farthest = 2.5 * median(radii);
  LinearRing kept;
  for (std::size_t i = 0; i < posts.size(); ++i) {
    if (radii[i] <= farthest) kept.push_back(posts[i]);
  }
  return kept;
}

std::vector<std::size_t> partners(const std::vector<OracleView>& views) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < views.size(); ++i) {
    std::size_t best = views.size();
    double best_off = 0;
    for (std::size_t j = 0; j < views.size(); ++j) {
      const double parallax = chord(views[i].middle() - views[j].middle());
      if (!(parallax > chord(kDegree)) || !(parallax < chord(60 * kDegree))) continue;
      const double off = std::abs(parallax - chord(15 * kDegree)) + (j < i ? chord(kDegree) : 0);
      if (best != views.size() && off >= best_off) continue;
      best = j;
      best_off = off;
    }
    result.push_back(best);
  }
  return result;
}

LinearRing paired_posts(const std::vector<OracleView>& views) {
  LinearRing posts;
  const std::vector<std::size_t> partner = partners(views);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (partner[i] == views.size() || (partner[i] < i && partner[partner[i]] == i)) continue;
    add_pair(posts, views[i], views[partner[i]], 0.5 * kDegree);
  }
  return posts;
}

LinearRing oracle_posts(const std::vector<OracleView>& views, Rule rule) {
  if (rule == Rule::kTrimmed) return trimmed(paired_posts(views), views.back().middle());
  LinearRing posts;
  for (std::size_t i = 0; i < views.size(); ++i) {
    for (std::size_t j = i + 1; j < views.size(); ++j) add_pair(posts, views[i], views[j], 5 * kDegree);
  }
  return posts;
}

// Andrew's monotone chain; counter-clockwise, empty below three posts.
LinearRing hull_of(LinearRing points) {
  if (points.size() < 3) return {};
  std::sort(points.begin(), points.end(), [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turns_left = [](const LinearRing& chain, Point p) {
    const Point& a = chain[chain.size() - 2];
    const Point& b = chain.back();
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
  };
  LinearRing hull;
  for (int pass = 0; pass < 2; ++pass) {
    LinearRing chain;
    for (const Point& p : points) {
      while (chain.size() >= 2 && !turns_left(chain, p)) chain.pop_back();
      chain.push_back(p);
    }
    hull.insert(hull.end(), chain.begin(), chain.end() - 1);
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

// ---- the robot's code

constexpr std::size_t kFew = 36;  // one every 10 degrees of a whole tour
using recon::SheafViews;

/// An object that keeps kViews views for its sheaf.
template <std::size_t kViews>
struct WithSheaf : config::Full {
  using ComparisonModels = recon::ModelList<recon::Cylinder, SheafViews<kViews>>;
};

template <std::size_t kViews>
struct Tour {
  std::unique_ptr<recon::Object<WithSheaf<kViews>>> object = std::make_unique<recon::Object<WithSheaf<kViews>>>();
  std::vector<OracleView> views;

  void add(const ExactView& view) {
    if (views.empty()) object->begin(1, 1, view.sighting, {});
    object->track(view.sighting.left.end, view.sighting.right.end, {});
    object->model(view.sighting, {});
    views.push_back({view.wedge.apex, view.wedge.left, view.wedge.right});
  }
  [[nodiscard]] auto kept() const { return object->comparison.template get<SheafViews<kViews>>().view(); }
  // Map frame of exact_view.hpp.
  [[nodiscard]] LinearRing hull(Rule rule) const {
    recon::PlaneSheaf<kViews, host::kSheafPosts> sheaf;
    rule == Rule::kPaper ? sheaf.build_paper(kept()) : sheaf.build(kept());
    LinearRing ring;
    for (const recon::Vec2& v : sheaf.hull()) {
      ring.push_back(
          {object->origin.x * 1e-5 + static_cast<double>(v.x()), object->origin.y * 1e-5 + static_cast<double>(v.y())});
    }
    return ring;
  }
  [[nodiscard]] LinearRing oracle(Rule rule) const { return hull_of(oracle_posts(views, rule)); }
};

LinearRing square_footprint() {
  return host::moved({{{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}}, {}}, 0.4, kCenter).outer;
}

template <std::size_t kViews>
Tour<kViews> tour(const LinearRing& footprint, const std::vector<Point>& lenses) {
  Tour<kViews> result;
  for (const Point& lens : lenses) result.add(view_of(footprint, lens));
  return result;
}

// The outlines of convex polygons lie farthest apart at a vertex.
double apart(const LinearRing& a, const LinearRing& b) {
  double farthest = 0;
  for (const Point& p : a) farthest = std::max(farthest, host::distance_to_outline(p, b));
  for (const Point& p : b) farthest = std::max(farthest, host::distance_to_outline(p, a));
  return farthest;
}

std::vector<Point> first_of(std::vector<Point> lenses, std::size_t count) {
  lenses.resize(count);
  return lenses;
}

TEST(Sheaf, EqualsTheRuleInDouble) {
  int compared = 0;
  int empty = 0;
  for (const bool spread : {true, false}) {
    for (const int views : {2, 4, 8, 18, 75}) {
      const auto lenses =
          spread ? arc(kCenter, 1.2, views) : first_of(arc(kCenter, 1.2, 75), static_cast<std::size_t>(views));
      const auto result = tour<host::kSheafViews>(square_footprint(), lenses);
      for (const Rule rule : kRules) {
        SCOPED_TRACE(std::string(name(rule)) + (spread ? " spread " : " in sequence ") + std::to_string(views));
        const LinearRing exact = result.oracle(rule);
        const LinearRing hull = result.hull(rule);
        ASSERT_EQ(hull.empty(), exact.empty());
        if (hull.empty()) {
          ++empty;
          continue;
        }
        EXPECT_GT(host::signed_area(hull), 0);
        EXPECT_FALSE(host::find_invalidity({hull, {}}).has_value());
        const double error = apart(hull, exact);
        const host::MultiPolygon truth{{square_footprint(), {}}};
        std::printf("  %-11s %s %2d views: %3zu vertices, %.1e m from the rule in double, R %5.1f %% P %5.1f %%\n",
                    name(rule), spread ? "spread     " : "in sequence", views, hull.size(), error,
                    100 * host::difference_area(truth, {{hull, {}}}) / host::area(truth),
                    100 * host::difference_area({{hull, {}}}, truth) / host::area({hull, {}}));
        EXPECT_LT(error, 2e-5);
        ++compared;
      }
    }
  }
  EXPECT_EQ(empty, 5);  // too few posts: paper 2 spread and 2, sheaf 2 and 4 spread and 2
  EXPECT_EQ(compared, 15);
}

// Edges half a degree off, some that lose 2 degrees of the object: wild posts, of which `sheaf` drops some.
TEST(Sheaf, EqualsTheRuleInDoubleWithNoise) {
  std::mt19937 random(11);
  const auto share = [&] { return static_cast<double>(random()) / 4294967295.0; };
  const auto off = [&] { return kDegree * (share() - 0.5 + (share() < 0.1 ? 2 : 0)); };
  std::size_t dropped = 0;
  for (int round = 0; round < 20; ++round) {
    for (const int views : {8, 18, 75}) {
      Tour<host::kSheafViews> noisy;
      for (const Point& lens : arc(kCenter, 1.2, views)) {
        const host::Wedge exact = view_of(square_footprint(), lens).wedge;
        noisy.add(view_between(lens, exact.right + off(), exact.left - off()));
      }
      for (const Rule rule : kRules) {
        const LinearRing hull = noisy.hull(rule);
        ASSERT_GE(hull.size(), 3U);
        EXPECT_LT(apart(hull, noisy.oracle(rule)), 2e-5) << name(rule) << ' ' << views << " round " << round;
      }
      dropped += paired_posts(noisy.views).size() - oracle_posts(noisy.views, Rule::kTrimmed).size();
    }
  }
  EXPECT_GT(dropped, 20U);
}

// The paper's claim (sec. II.C): without noise the hull of all pairs contains the object.
TEST(Sheaf, PaperHullContainsTheObjectWithoutNoise) {
  const host::MultiPolygon truth{{square_footprint(), {}}};
  const auto result = tour<host::kSheafViews>(square_footprint(), arc(kCenter, 1.2, 75));
  EXPECT_LT(host::difference_area(truth, {{result.hull(Rule::kPaper), {}}}), 1e-9);
}

double share_outside(const LinearRing& a, const LinearRing& b) {
  return host::difference_area({{a, {}}}, {{b, {}}}) / host::area({a, {}});
}

// More views than the store holds: it keeps some, evenly. The hull of `sheaf` stays near that of all views. That of
// `sheaf_paper` consists of the posts that its widest pairs make a metre outside the object: fewer pairs make it
// smaller, not wrong.
template <std::size_t kViews>
void expect_close_at_the_bound(int views, double largest_gap) {
  const LinearRing footprint = square_footprint();
  const auto result = tour<kViews>(footprint, arc(kCenter, 1.2, views));
  ASSERT_EQ(result.kept().size(), kViews);
  for (const Rule rule : kRules) {
    const LinearRing hull = result.hull(rule);
    const LinearRing exact = result.oracle(rule);
    ASSERT_GE(hull.size(), 3U);
    const double gap = apart(hull, exact);
    std::printf(
        "  %-11s %4d views, %2zu kept: %5.1f mm from the hull of all; R %.2f %% (all: %.2f), P %.1f %% (%.1f)\n",
        name(rule), views, kViews, 1e3 * gap, 100 * share_outside(footprint, hull),
        100 * share_outside(footprint, exact), 100 * share_outside(hull, footprint),
        100 * share_outside(exact, footprint));
    EXPECT_LT(share_outside(footprint, hull), 0.001);
    EXPECT_LT(share_outside(hull, exact), rule == Rule::kPaper ? 1e-5 : 0.02);
    EXPECT_NEAR(share_outside(hull, footprint), share_outside(exact, footprint), rule == Rule::kPaper ? 0.01 : 0.1);
    EXPECT_LT(gap, rule == Rule::kPaper ? 0.5 : largest_gap);
  }
}
TEST(Sheaf, StaysCloseAtTheBound) {
  expect_close_at_the_bound<host::kSheafViews>(150, 2e-3);
  expect_close_at_the_bound<host::kSheafViews>(2000, 2e-3);
  expect_close_at_the_bound<kFew>(75, 8e-3);
  expect_close_at_the_bound<kFew>(2000, 8e-3);
}

Point mirrored(Point p) { return {p.x, 2 * kCenter.y - p.y}; }

TEST(Sheaf, AMirroredSceneHasAMirroredHull) {
  LinearRing reflected;
  for (const Point& p : square_footprint()) reflected.insert(reflected.begin(), mirrored(p));
  for (const int views : {8, 18, 75, 200}) {
    const std::vector<Point> lenses = arc(kCenter, 1.2, views);
    std::vector<Point> others;
    for (const Point& lens : lenses) others.push_back(mirrored(lens));
    const auto original = tour<host::kSheafViews>(square_footprint(), lenses);
    const auto mirror = tour<host::kSheafViews>(reflected, others);
    for (const Rule rule : kRules) {
      LinearRing expected;
      for (const Point& p : original.hull(rule)) expected.insert(expected.begin(), mirrored(p));
      ASSERT_GE(expected.size(), 3U);
      EXPECT_LT(apart(mirror.hull(rule), expected), 4e-5) << name(rule) << ' ' << views;
    }
  }
}

TEST(Sheaf, TurnsAndShiftsWithTheScene) {
  constexpr Point kShift{-2.5, 1.5};
  for (const double angle : {0.7, 2.0, -1.3}) {
    for (const int views : {8, 18, 75, 200}) {
      const auto placed = [&](const LinearRing& ring) { return host::moved({ring, {}}, angle, kShift).outer; };
      const std::vector<Point> lenses = arc(kCenter, 1.2, views);
      const auto original = tour<host::kSheafViews>(square_footprint(), lenses);
      const auto other = tour<host::kSheafViews>(placed(square_footprint()), placed(lenses));
      for (const Rule rule : kRules) {
        ASSERT_GE(original.hull(rule).size(), 3U);
        EXPECT_LT(apart(other.hull(rule), placed(original.hull(rule))), 4e-5) << name(rule) << ' ' << views;
      }
    }
  }
}

// 100 m from the origin nothing gets worse: the views live in a local frame.
TEST(Sheaf, FarFromTheOriginIsAsExact) {
  constexpr std::int32_t kFar = 100 * recon::kMapUnitsPerMetre;
  Tour<host::kSheafViews> near;
  Tour<host::kSheafViews> far;
  for (const Point& lens : arc(kCenter, 1.2, 75)) {
    ExactView view = view_of(square_footprint(), lens);
    near.add(view);
    view.sighting.anchor = {kFar, -kFar};
    far.add(view);
  }
  for (const Rule rule : kRules) {
    LinearRing shifted = far.hull(rule);
    for (Point& p : shifted) p = {p.x - 100, p.y + 100};
    ASSERT_GE(shifted.size(), 3U);
    EXPECT_LT(apart(shifted, near.hull(rule)), 1e-5);
  }
}

}  // namespace
}  // namespace fencepost::test
