// Outlines of grids as polygons.
#include "host/replay/models.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "host/geometry/planar.hpp"

namespace fencepost::test {
namespace {

constexpr std::size_t kCells = 32;
using Words = std::array<std::uint32_t, kCells>;

recon::ObjectCore placed_object() {
  recon::ObjectCore object;
  object.id = 1;
  object.relocations = 1;
  object.origin = {100'000, -200'000};  // (1, -2) m
  return object;
}

host::MultiPolygon outline(const Words& words) {
  const recon::GridPlacement placement{{-0.16F, -0.16F}, 0.01F};
  return host::carve_model(placed_object(), "carve", placement, kCells, words).geometry;
}

TEST(CarveModel, ASolidGridIsItsSquare) {
  Words words;
  words.fill(0xFFFFFFFFU);
  const host::MultiPolygon areas = outline(words);
  ASSERT_EQ(areas.size(), 1U);
  ASSERT_EQ(areas[0].outer.size(), 4U);
  EXPECT_NEAR(areas[0].outer[0].x, 0.84, 1e-6);
  EXPECT_NEAR(areas[0].outer[0].y, -2.16, 1e-6);
  EXPECT_NEAR(host::area(areas), 0.32 * 0.32, 1e-7);
}

TEST(CarveModel, HolesBelongToTheRegionAroundThem) {
  Words words;
  words.fill(0xFFFFFFFFU);
  for (std::size_t row = 10; row < 20; ++row) words[row] &= ~(0x3FFU << 10U);  // a 10 x 10 hole
  words[14] |= 1U << 14U;                                                      // with an island
  const host::MultiPolygon areas = outline(words);
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_NEAR(host::area(areas), (1024 - 100 + 1) * 1e-4, 1e-7);
  EXPECT_EQ(areas[0].holes.size() + areas[1].holes.size(), 1U);
}

// Any pattern: the area is that of the solid cells, and every polygon is valid.
TEST(CarveModel, RandomPatternsKeepTheirArea) {
  std::mt19937 random(3);
  for (int round = 0; round < 50; ++round) {
    Words words;
    std::size_t solid = 0;
    for (std::uint32_t& word : words) {
      word =
          static_cast<std::uint32_t>(random()) & (round % 2 == 0 ? static_cast<std::uint32_t>(random()) : 0xFFFFFFFFU);
      solid += static_cast<std::size_t>(__builtin_popcount(word));
    }
    const host::MultiPolygon areas = outline(words);
    EXPECT_NEAR(host::area(areas), static_cast<double>(solid) * 1e-4, 1e-6);
    for (const host::Polygon& polygon : areas) {
      const auto invalid = host::find_invalidity(polygon);
      EXPECT_FALSE(invalid.has_value()) << invalid->reason;
    }
  }
}

TEST(Models, SayWhyTheyAreEmpty) {
  recon::ObjectCore nothing;
  Words words{};
  EXPECT_EQ(host::cylinder_model(nothing).reason, "only censored ends seen");
  EXPECT_EQ(host::carve_model(nothing, "carve", {}, kCells, words).reason, "no place yet");
  EXPECT_EQ(host::clip_model(placed_object(), "clip", {}).reason, "contradictory wedges carved everything away");
  EXPECT_FALSE(host::cylinder_paper_model(nothing, {}).circle.has_value());
  EXPECT_EQ(host::sheaf_model(nothing, "sheaf", {}, recon::SheafRefusal::kFewPosts).reason, "fewer than three posts");
}

TEST(SheafModel, IsTheHullInTheMapFrame) {
  const std::array<recon::Vec2, 3> hull{{{0, 0}, {0.2F, 0}, {0, 0.1F}}};
  const host::ModelResult model = host::sheaf_model(placed_object(), "sheaf_paper", hull, recon::SheafRefusal::kNone);
  EXPECT_EQ(model.name, "sheaf_paper");
  ASSERT_EQ(model.geometry.size(), 1U);
  EXPECT_NEAR(model.geometry[0].outer[1].x, 1.2, 1e-6);
  EXPECT_NEAR(model.geometry[0].outer[2].y, -1.9, 1e-6);
  EXPECT_NEAR(host::area(model.geometry), 0.01, 1e-7);
  EXPECT_TRUE(model.reason.empty());
}

}  // namespace
}  // namespace fencepost::test
