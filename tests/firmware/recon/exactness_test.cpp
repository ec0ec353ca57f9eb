// Sub-pixel edges, unoccluded: what each model must reach without noise.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>

#include "firmware/config/profile.hpp"
#include "firmware/recon/track/object.hpp"
#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "host/models/carving.hpp"
#include "host/models/cylinder_paper.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {
namespace {

using host::LinearRing;
using host::Point;

constexpr Point kCenter{1.05, 0.05};
constexpr int kViews[] = {2, 4, 8, 18, 75};

struct Shape {
  const char* name;
  LinearRing ring;
};

LinearRing placed(const LinearRing& ring, double angle) { return host::moved({ring, {}}, angle, kCenter).outer; }

std::vector<Shape> shapes() {
  return {
      {"square", placed({{-0.05, -0.05}, {0.05, -0.05}, {0.05, 0.05}, {-0.05, 0.05}}, 0.4)},
      {"stick", placed({{-0.12, -0.01}, {0.12, -0.01}, {0.12, 0.01}, {-0.12, 0.01}}, 1.0)},
      {"triangle", placed({{-0.06, -0.05}, {0.07, -0.02}, {-0.01, 0.08}}, 2.2)},
      {"L", placed({{-0.08, -0.08}, {0.08, -0.08}, {0.08, -0.03}, {-0.03, -0.03}, {-0.03, 0.08}, {-0.08, 0.08}}, 0.7)},
      {"round", placed(host::circle_ring({0, 0}, 0.07), 0)}};
}

/// A robot whose objects are carved, too.
template <class Robot, std::size_t kCells = 128, std::size_t kVertices = 192, std::size_t kPending = 64>
struct Carves : Robot {
  using ComparisonModels =
      recon::ModelList<recon::Cylinder, recon::CylinderPaper, recon::Carving<kCells, kVertices, kPending>>;
};
using Desk = Carves<config::Full>;
using Coarse = Carves<config::Full, 64, 96, 16>;

template <class Profile>
struct Reconstruction {
  std::unique_ptr<recon::Object<Profile>> object = std::make_unique<recon::Object<Profile>>();
  std::vector<host::Wedge> wedges;

  void add(const ExactView& view) {
    if (wedges.empty()) object->begin(1, 1, view.sighting, {});
    object->track(view.sighting.left.end, view.sighting.right.end, {});
    object->model(view.sighting, {});
    wedges.push_back(view.wedge);
  }
  [[nodiscard]] const auto& carving() const { return object->comparison.template get<2>(); }
  [[nodiscard]] Point origin() const { return {object->origin.x * 1e-5, object->origin.y * 1e-5}; }
  [[nodiscard]] host::MultiPolygon clip() const {
    host::Polygon polygon;
    for (const recon::Vec2& v : carving().clip().vertices()) {
      polygon.outer.push_back({origin().x + static_cast<double>(v.x()), origin().y + static_cast<double>(v.y())});
    }
    return {polygon};
  }
  // The same wedges in double, from the same square.
  [[nodiscard]] host::MultiPolygon exact() const {
    const LinearRing arena = host::square(origin(), 2 * static_cast<double>(recon::kArenaHalfSide));
    return {{host::intersect_wedges(arena, wedges), {}}};
  }
};

template <class Profile>
Reconstruction<Profile> reconstruct(const LinearRing& footprint, int views) {
  Reconstruction<Profile> result;
  for (const Point& lens : arc(kCenter, 1.2, views)) result.add(view_of(footprint, lens));
  return result;
}

TEST(Exactness, ClipEnclosesTheFootprintAndEqualsTheWedgeIntersection) {
  int compared = 0;
  for (const Shape& shape : shapes()) {
    for (const int views : kViews) {
      SCOPED_TRACE(std::string(shape.name) + ", " + std::to_string(views) + " views");
      const auto result = reconstruct<Desk>(shape.ring, views);
      ASSERT_TRUE(result.object->placed());
      const host::MultiPolygon truth{{shape.ring, {}}};
      const double lost = host::difference_area(truth, result.clip()) / host::area(truth);
      EXPECT_LT(lost, 2e-5);  // float vertices: micrometres along the outline
      const auto apart = host::outline_distance(result.clip(), result.exact(), 2e-4);
      ASSERT_TRUE(apart.has_value());
      EXPECT_LT(apart->hausdorff(), 1e-4);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 25);
}

// A polygon with fewer vertices may be larger than the wedges, never smaller.
template <class Profile>
void expect_outer_approximation(double largest_gap) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const auto result = reconstruct<Profile>(shape.ring, 75);
    const double lost = host::difference_area(result.exact(), result.clip());
    EXPECT_LT(lost, 1e-7);
    const auto apart = host::outline_distance(result.clip(), result.exact(), 2e-4);
    ASSERT_TRUE(apart.has_value());
    EXPECT_LT(apart->hausdorff(), largest_gap);
  }
}
TEST(Exactness, CoarseClipLosesNothing) { expect_outer_approximation<Coarse>(5e-4); }
TEST(Exactness, SmallClipLosesNothing) { expect_outer_approximation<Carves<config::Small>>(2e-3); }
TEST(Exactness, MicroClipLosesNothing) { expect_outer_approximation<Carves<config::Micro>>(2e-3); }

// A cell that the footprint touches is never carved.
template <class Profile>
double footprint_outside_grid(const Reconstruction<Profile>& result, const LinearRing& footprint) {
  const auto& grid = result.carving().grid();
  constexpr std::size_t kCells = std::remove_cvref_t<decltype(grid)>::kCells;
  const double cell = static_cast<double>(grid.placement().cell);
  const Point low{result.origin().x + static_cast<double>(grid.placement().low.x()),
                  result.origin().y + static_cast<double>(grid.placement().low.y())};
  const host::MultiPolygon truth{{footprint, {}}};
  std::size_t touched = 0;
  std::size_t lost = 0;
  for (std::size_t row = 0; row < kCells; ++row) {
    for (std::size_t column = 0; column < kCells; ++column) {
      const Point a{low.x + static_cast<double>(column) * cell, low.y + static_cast<double>(row) * cell};
      const host::Polygon square{{a, {a.x + cell, a.y}, {a.x + cell, a.y + cell}, {a.x, a.y + cell}}, {}};
      if (grid.solid(column, row)) continue;
      const double covered = host::intersection_area(truth, {square});
      if (!(covered > 1e-9 * cell)) continue;
      ++lost;
    }
  }
  EXPECT_EQ(lost, 0U);
  (void)touched;
  const double side = cell * static_cast<double>(kCells);
  const host::Polygon whole{{low, {low.x + side, low.y}, {low.x + side, low.y + side}, {low.x, low.y + side}}, {}};
  return host::difference_area(truth, {whole}) / host::area(truth);
}

template <class Profile>
void expect_grid_keeps_footprint() {
  for (const Shape& shape : shapes()) {
    for (const int views : kViews) {
      SCOPED_TRACE(std::string(shape.name) + ", " + std::to_string(views) + " views");
      const auto result = reconstruct<Profile>(shape.ring, views);
      ASSERT_TRUE(result.object->placed());
      const double outside = footprint_outside_grid(result, shape.ring);
      std::printf("  grid %-5s %-8s %2d views: cell %6.2f mm, footprint outside the grid %.4f %%\n",
                  std::string(Profile::kName).c_str(), shape.name, views,
                  1e3 * static_cast<double>(result.carving().grid().placement().cell), 100 * outside);
      EXPECT_LT(outside, 1e-4);
    }
  }
}
TEST(Exactness, FullGridNeverCarvesTheFootprint) { expect_grid_keeps_footprint<Desk>(); }
TEST(Exactness, CoarseGridNeverCarvesTheFootprint) { expect_grid_keeps_footprint<Coarse>(); }

TEST(Exactness, CylinderIsRecoveredWithinAMillimetre) {
  for (const double radius : {0.03, 0.07, 0.2}) {
    for (const int views : kViews) {
      SCOPED_TRACE("radius " + std::to_string(radius) + ", " + std::to_string(views) + " views");
      recon::Object<Desk> object;
      bool first = true;
      for (const Point& lens : arc(kCenter, 1.2, views)) {
        const ExactView view = view_of_circle(kCenter, radius, lens);
        if (first) object.begin(1, 1, view.sighting, {});
        first = false;
        object.track(view.sighting.left.end, view.sighting.right.end, {});
        object.model(view.sighting, {});
      }
      const recon::CylinderEstimate& estimate = object.cylinder.estimate();
      ASSERT_TRUE(estimate.ok()) << name(estimate.refusal);
      EXPECT_NEAR(object.origin.x * 1e-5 + static_cast<double>(estimate.center.x()), kCenter.x, 1e-3);
      EXPECT_NEAR(object.origin.y * 1e-5 + static_cast<double>(estimate.center.y()), kCenter.y, 1e-3);
      EXPECT_NEAR(static_cast<double>(estimate.radius), radius, 1e-3);
      const recon::PaperCylinder paper = object.comparison.get<recon::CylinderPaper>().solve();
      ASSERT_TRUE(paper.ok);
      EXPECT_NEAR(static_cast<double>(paper.radius), radius, 1e-3);
    }
  }
}

// 100 m from the origin nothing gets worse: models live in a local frame.
TEST(Exactness, FarFromTheOriginIsAsExact) {
  const LinearRing ring = shapes()[0].ring;
  Reconstruction<Desk> near;
  Reconstruction<Desk> far;
  constexpr std::int32_t kFar = 100 * recon::kMapUnitsPerMetre;
  for (const Point& lens : arc(kCenter, 1.2, 18)) {
    ExactView view = view_of(ring, lens);
    near.add(view);
    view.sighting.anchor = {kFar, -kFar};
    far.add(view);
  }
  ASSERT_EQ(near.carving().clip().vertices().size(), far.carving().clip().vertices().size());
  EXPECT_EQ(far.object->origin.x - near.object->origin.x, kFar);
  EXPECT_EQ(far.object->origin.y - near.object->origin.y, -kFar);
  for (std::size_t i = 0; i < near.carving().clip().vertices().size(); ++i) {
    EXPECT_LT((near.carving().clip().vertices()[i] - far.carving().clip().vertices()[i]).norm(), 1e-6F);
  }
}

}  // namespace
}  // namespace fencepost::test
