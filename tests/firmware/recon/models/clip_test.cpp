#include "firmware/recon/models/clip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <span>

#include "host/geometry/half_planes.hpp"
#include "host/geometry/planar.hpp"
#include "host/models/carve.hpp"

#include "tests/firmware/recon/sweep.hpp"

namespace fencepost::test {
namespace {

using recon::HalfPlane;
using recon::Vec2;

template <std::size_t N>
host::MultiPolygon polygon_of(const recon::ConvexClip<N>& clip) {
  host::Polygon polygon;
  for (const Vec2& v : clip.vertices()) {
    polygon.outer.push_back({static_cast<double>(v.x()), static_cast<double>(v.y())});
  }
  return {polygon};
}

HalfPlane half_plane(double angle, double bound) {
  return {{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}, static_cast<float>(bound)};
}

TEST(ConvexClip, CutsACornerOffTheSquare) {
  recon::ConvexClip<16> clip;
  clip.start();
  ASSERT_EQ(clip.vertices().size(), 4U);
  // x + y <= 3 (normal at 45 deg, bound 3 / sqrt 2) takes the triangle (1,2)-(2,1)-(2,2) off.
  clip.cut(half_plane(M_PI / 4, 3 / std::sqrt(2)));
  ASSERT_EQ(clip.vertices().size(), 5U);
  EXPECT_NEAR(host::area(polygon_of(clip)), 16 - 0.5, 1e-5);
}

TEST(ConvexClip, KeepsEverythingOrNothing) {
  recon::ConvexClip<16> clip;
  clip.start();
  clip.cut(half_plane(0.3, 10));
  EXPECT_EQ(clip.vertices().size(), 4U);
  clip.cut(half_plane(0.3, -10));
  EXPECT_TRUE(clip.vertices().empty());
  clip.cut(half_plane(0.3, 10));
  EXPECT_TRUE(clip.vertices().empty());  // an empty polygon stays empty
}

// Rounding may leave an almost straight chain with a dent: only the run around the innermost vertex is kept then,
// wherever the list begins.
TEST(ConvexClip, ADentInWhatIsCutOffIsCutOffAsWell) {
  const std::array<Vec2, 7> dented = {Vec2{-1, -1}, {1, -1},          {1, 0.9F}, {0.5F, 1.0005F},
                                      {0, 0.999F},  {-0.5F, 1.0005F}, {-1, 0.8F}};
  for (std::size_t begin = 0; begin < dented.size(); ++begin) {
    std::array<Vec2, 12> v;
    for (std::size_t i = 0; i < dented.size(); ++i) v[i] = dented[(begin + i) % dented.size()];
    const std::size_t size = recon::clip_convex(v, dented.size(), {{0, 1}, 1});
    host::Polygon polygon;
    for (std::size_t i = 0; i < size; ++i) {
      polygon.outer.push_back({static_cast<double>(v[i].x()), static_cast<double>(v[i].y())});
      EXPECT_LE(v[i].y(), 1 + 1e-6F);
      EXPECT_GT(std::fabs(v[i].x()), 0.4F) << "the dent is still there, from vertex " << begin;
    }
    // Four corners and two crossings at y = 1: x = 0.5025 on the right (0.1 of 0.1005 up), -0.5012 on the left (0.2 of
    // 0.2005).
    EXPECT_EQ(size, 6U) << begin;
    const double right = 1 - 0.5 * 0.1 / 0.1005;
    const double left = 1 - 0.5 * 0.2 / 0.2005;
    // Trapezoids from y = -1: shoelace of (-1,-1) (1,-1) (1,0.9) (right,1) (-left,1) (-1,0.8).
    const double x[] = {-1, 1, 1, right, -left, -1};
    const double y[] = {-1, -1, 0.9, 1, 1, 0.8};
    double twice = 0;
    for (int i = 0; i < 6; ++i) twice += x[i] * y[(i + 1) % 6] - x[(i + 1) % 6] * y[i];
    EXPECT_NEAR(host::area({polygon}), twice / 2, 1e-5) << begin;
  }
  std::array<Vec2, 12> v{};
  std::copy(dented.begin(), dented.end(), v.begin());
  EXPECT_EQ(recon::clip_convex(v, dented.size(), {{0, 1}, -1.5F}), 0U);
  EXPECT_EQ(recon::clip_convex(v, dented.size(), {{0, 1}, 1.1F}), dented.size());
}

// Random cuts against the same cuts in double. Every polygon stays convex, and encloses the exact one.
template <std::size_t N>
void fuzz(unsigned seed, double largest_area_excess) {
  std::mt19937 random(seed);
  const auto uniform = [&](double a, double b) { return a + (b - a) * (static_cast<double>(random()) / 4294967295.0); };
  int compared = 0;
  for (int round = 0; round < 300; ++round) {
    recon::ConvexClip<N> clip;
    clip.start();
    host::LinearRing exact = host::square({0, 0}, 4);
    const double size = uniform(0.01, 0.5);
    for (int cut = 0; cut < 150; ++cut) {
      // Tangents of a disc, in runs of nearly equal and exactly repeated ones.
      const double angle = cut % 3 == 0 ? 0.1 * std::floor(uniform(0, 63)) : uniform(0, 2 * M_PI);
      const double bound = size * (1 + (cut % 5 == 0 ? 0 : uniform(0, 0.2)));
      const HalfPlane plane = half_plane(angle, bound);
      clip.cut(plane);
      exact = host::clipped(exact, {{static_cast<double>(plane.normal.x()), static_cast<double>(plane.normal.y())},
                                    static_cast<double>(plane.bound)});
    }
    const auto v = clip.vertices();
    ASSERT_GE(v.size(), 3U);
    ASSERT_LE(v.size(), N);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Vec2 a = v[(i + 1) % v.size()] - v[i];
      const Vec2 b = v[(i + 2) % v.size()] - v[(i + 1) % v.size()];
      ASSERT_GT(recon::cross(a, b), -1e-6F) << "not convex at " << i;
    }
    const double whole = host::area({exact, {}});
    EXPECT_LT(host::difference_area({{exact, {}}}, polygon_of(clip)), 2e-5 * whole + 1e-9);
    EXPECT_LT(host::area(polygon_of(clip)) / whole, 1 + largest_area_excess);
    ++compared;
  }
  EXPECT_EQ(compared, 300);
}
TEST(ConvexClip, RandomCutsMatchDoubleWithRoomEnough) { fuzz<192>(1, 2e-4); }
TEST(ConvexClip, RandomCutsWithLittleRoomOnlyGrow) { fuzz<24>(2, 0.05); }
TEST(ConvexClip, RandomCutsWithVeryLittleRoomOnlyGrow) { fuzz<8>(3, 0.6); }

// Every cell against the definition: carved if and only if all four corners are outside by more than the guard.
TEST(CarveGrid, CarvesExactlyTheCellsThatLieWhollyOutside) {
  std::mt19937 random(4);
  const auto uniform = [&](double a, double b) { return a + (b - a) * (static_cast<double>(random()) / 4294967295.0); };
  std::size_t carved_in_all = 0;
  for (int round = 0; round < 400; ++round) {
    std::array<std::int16_t, 64> begin{};
    std::array<std::int16_t, 64> end{};
    end.fill(64);
    const recon::GridPlacement placement{{static_cast<float>(uniform(-1, 0)), static_cast<float>(uniform(-1, 0))},
                                         static_cast<float>(uniform(0.002, 0.05))};
    const double angle = round % 4 == 0 ? M_PI / 2 * (round % 16 / 4) : uniform(0, 2 * M_PI);
    const HalfPlane plane = half_plane(angle, uniform(-1, 1));
    recon::carve_half_plane({begin, end}, 64, {0, 64}, placement, plane);
    for (std::size_t j = 0; j < 64; ++j) {
      for (std::size_t i = 0; i < 64; ++i) {
        double inside = 1e9;  // of the innermost corner: distance beyond the line
        for (const std::size_t di : {0U, 1U}) {
          for (const std::size_t dj : {0U, 1U}) {
            const double x =
                static_cast<double>(placement.low.x()) + static_cast<double>(placement.cell) * double(i + di);
            const double y =
                static_cast<double>(placement.low.y()) + static_cast<double>(placement.cell) * double(j + dj);
            inside = std::min(inside, static_cast<double>(plane.normal.x()) * x +
                                          static_cast<double>(plane.normal.y()) * y - static_cast<double>(plane.bound));
          }
        }
        const auto column = static_cast<std::int16_t>(i);
        const bool carved = column < begin[j] || column >= end[j];
        if (carved) ++carved_in_all;
        if (inside <= 0) {
          ASSERT_FALSE(carved) << "a cell that is not wholly outside, round " << round;
        }
        if (inside > 1e-5) {
          ASSERT_TRUE(carved) << "a cell that is wholly outside, round " << round;
        }
      }
    }
  }
  EXPECT_GT(carved_in_all, 100'000U);
}

// The same to the last bit, whatever the processor does at a time: each row by itself, in floats, a branch a case. The
// digest hangs on it.
TEST(CarveGrid, EachRowIsThatOfPlainFloats) {
  std::mt19937 random(5);
  const auto uniform = [&](double a, double b) { return a + (b - a) * (static_cast<double>(random()) / 4294967295.0); };
  constexpr std::size_t kSide = 96;
  int cut_rows = 0;
  for (int round = 0; round < 3000; ++round) {
    std::array<std::int16_t, kSide> begin{};
    std::array<std::int16_t, kSide> end{};
    end.fill(kSide);
    const auto cell = static_cast<float>(round % 3 == 0 ? 0.03125 : uniform(0.002, 0.05));  // whole columns, too
    const recon::GridPlacement placement{{round % 3 == 0 ? -0.5F : static_cast<float>(uniform(-1, 0)), -0.5F}, cell};
    const double angle = round % 4 == 0 ? M_PI / 2 * (round % 16 / 4) : uniform(0, 2 * M_PI);
    const HalfPlane plane = half_plane(angle, round % 3 == 0 ? std::floor(uniform(-8, 8)) / 8 : uniform(-1, 1));
    recon::carve_half_plane({begin, end}, kSide, {0, kSide}, placement, plane);
    const float nx = plane.normal.x();
    const float ny = plane.normal.y();
    const float bound = (plane.bound + recon::kCarveGuard - plane.normal.dot(placement.low)) / cell;
    for (std::size_t j = 0; j < kSide; ++j) {
      const float rest = bound - ny * static_cast<float>(j + (ny < 0 ? 1 : 0));
      int low = 0;
      int high = kSide;
      if (nx > 1e-6F) {
        const float x = rest / nx;
        high = rest < 0 ? 0 : x < kSide ? std::min<int>(static_cast<int>(x) + 1, kSide) : int{kSide};
      } else if (nx < -1e-6F) {
        const float x = rest / nx;
        const float most = std::min<float>(x, kSide);
        if (rest < 0 && x > 1) low = x > kSide ? int{kSide} : static_cast<int>(std::ceil(most)) - 1;
      } else if (rest + 1e-6F * kSide < 0) {
        high = 0;
      }
      ASSERT_EQ(begin[j], low) << "round " << round << ", row " << j;
      ASSERT_EQ(end[j], high) << "round " << round << ", row " << j;
      cut_rows += low > 0 || high < static_cast<int>(kSide) ? 1 : 0;
    }
  }
  EXPECT_GT(cut_rows, 50'000);
}

TEST(CarveGrid, TheWordsAreTheSolidCells) {
  recon::CarveGrid<96> grid;
  grid.start();
  for (int i = 0; i < 7; ++i) {
    grid.carve(half_plane(0.9 * i, 0.1 + 0.2 * i));
    const auto words = grid.words();
    for (std::size_t row = 0; row < 96; ++row) {
      for (std::size_t column = 0; column < 96; ++column) {
        const bool bit = ((words[row * 3 + column / 32] >> (column % 32)) & 1U) != 0;
        ASSERT_EQ(bit, grid.solid(column, row)) << column << ", " << row;
      }
    }
  }
}

TEST(CarveGrid, NeverGrowsBackAndKeepsItsWedgesWhenPlacedAnew) {
  recon::CarveGrid<64> grid;
  recon::ConvexClip<96> clip;
  grid.start();
  clip.start();
  double last_area = 16;
  int placements = 0;
  for (int i = 0; i < 40; ++i) {
    const HalfPlane plane = half_plane(2.4 * i, 0.05 + 0.5 / (1 + i));
    clip.cut(plane);
    grid.carve(plane);
    grid.refine(clip.vertices());
    std::size_t solid = 0;
    for (std::size_t row = 0; row < 64; ++row) {
      for (std::size_t column = 0; column < 64; ++column) solid += grid.solid(column, row) ? 1U : 0U;
    }
    const auto cell = static_cast<double>(grid.placement().cell);
    const double area = static_cast<double>(solid) * cell * cell;
    const double exact = host::area(polygon_of(clip));
    EXPECT_GE(area, exact * 0.9999) << i;
    EXPECT_LE(area, last_area * 1.0001) << i;  // finer cells: never more than before
    EXPECT_LE(area, exact + 4 * 64 * cell * cell) << i;
    last_area = area;
    placements = grid.placements();
  }
  EXPECT_GE(placements, 3);
  EXPECT_LE(placements, 9);
}

TEST(CarveGrid, ManyRefinementsAreBounded) {
  recon::CarveGrid<32> grid;
  recon::ConvexClip<24> clip;
  grid.start();
  clip.start();
  for (double size = 1.9; size > 0.001; size *= 0.97) {
    for (int side = 0; side < 4; ++side) {
      clip.cut(half_plane(side * M_PI / 2, size));
      grid.carve(half_plane(side * M_PI / 2, size));
    }
    grid.refine(clip.vertices());
  }
  EXPECT_LE(grid.placements(), 9);
  EXPECT_NEAR(grid.placement().cell * 32, 0.04F, 0.03F);
}

void tell_polygon(Sweep& sweep, std::span<const Vec2> vertices) {
  sweep.tell("vertices", vertices.size());
  for (const Vec2& v : vertices) {
    sweep.tell("x", v.x());
    sweep.tell("y", v.y());
  }
}

// Through corners, along sides, past both: with room for few vertices, so that edges are given up.
TEST(ConvexClip, OfCutsThroughItsCorners) {
  Draw draw(71);
  Sweep sweep;
  const auto run = [&](auto clip) {
    clip.start();
    for (int i = 0; i < 24; ++i) {
      const Vec2 normal = draw.of<Vec2>({{1, 0}, {0, 1}, {0.6F, 0.8F}, {0.8F, 0.6F}, {0.70710678F, 0.70710678F}});
      const Vec2 sides{draw.coin() ? normal.x() : -normal.x(), draw.coin() ? normal.y() : -normal.y()};
      clip.cut({sides, draw.one_in(12) ? draw.steps(-16, 4, 0.125F) : draw.steps(2, 22, 0.125F)});
      tell_polygon(sweep, clip.vertices());
      const recon::Bounds box = recon::bounds_of(clip.vertices());
      sweep.tell("box", box.high.x() - box.low.x() + 16 * (box.high.y() - box.low.y()));
    }
  };
  for (int i = 0; i < 150; ++i) {
    run(recon::ConvexClip<8>());
    run(recon::ConvexClip<12>());
  }
  expect_said(sweep, {"vertices 4923 ee5c37ef", "x 23246 b7f17d87", "y 23302 d3a9f2eb", "box 4922 96b9b226"});
}

// The remainder of few vertices that are small multiples of the shallowest cut apart. The span has room for a few more
// vertices, or for none.
TEST(ConvexClip, OfCutsAsShallowAsTheShallowest) {
  constexpr float u = recon::kShallowestCut;
  Draw draw(72);
  Sweep sweep;
  for (int i = 0; i < 20'000; ++i) {
    std::array<Vec2, 8> v;
    std::size_t size = 0;
    const auto near = [&](float x, float y) {
      v[size++] = {x == 0 ? draw.of({0.0F, u, -u, 2 * u, 4 * u}) : x, y == 0 ? draw.of({0.0F, u, -u, 2 * u}) : y};
    };
    near(-1, -1);
    if (draw.coin()) near(0, -1.25F);
    near(1, -1);
    if (draw.coin()) near(1.25F, 0);
    near(0, 1);
    if (draw.coin()) near(0, 1);
    if (draw.one_in(3)) near(-1.25F, 0);
    const Vec2 normal = draw.of<Vec2>({{1, 0}, {-1, 0}, {0, 1}, {0, -1}});
    const bool far = normal.y() != 0 && draw.coin();
    const float bound = draw.of({0.0F, u, -u, 2 * u}) + (far ? 1.0F : 0.0F);
    const std::size_t room = draw.coin() ? size + 2 : draw.between<std::size_t>(size, 8);
    const std::size_t left =
        recon::clip_convex(std::span(v).first(std::min<std::size_t>(room, 8)), size, {normal, bound});
    tell_polygon(sweep, std::span(v).first(left));
  }
  expect_said(sweep, {"vertices 20000 a36ed90a", "x 79899 bdf4a74b", "y 84221 c75197e6"});
}

// A grid is placed anew where the clip with its margin is smaller than the share of its side, and not where it is
// equal.
TEST(CarveGrid, IsPlacedAnewBelowItsShare) {
  const auto placements_for = [](float extent) {
    const auto grid = std::make_unique<recon::CarveGrid<32>>();
    grid->start();
    const std::array<Vec2, 4> clip = {Vec2{0, 0}, {extent, 0}, {extent, 0.5F}, {0, 0.5F}};
    grid->refine(clip);
    return static_cast<int>(grid->placements());
  };
  const float share = recon::kRefineShare * (4.0F / 32 * 32);
  float extent = 2.2F;
  while (recon::kRefineMargin * extent < share) extent = std::nextafter(extent, 3.0F);
  EXPECT_EQ(recon::kRefineMargin * extent, share) << "some float has just this product";
  EXPECT_EQ(placements_for(std::nextafter(extent, 0.0F)), 1);
  EXPECT_EQ(placements_for(extent), 0);
  const auto grid = std::make_unique<recon::CarveGrid<32>>();
  grid->start();
  const std::array<Vec2, 3> line = {Vec2{0, 0}, {0.5F, 0}, {0.5F, 0.5F}};
  grid->refine(std::span(line).first(2));
  EXPECT_EQ(grid->placements(), 0) << "two points are no clip";
  grid->refine(line);
  EXPECT_EQ(grid->placements(), 1);
}

}  // namespace
}  // namespace fencepost::test
