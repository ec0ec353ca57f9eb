// Objects as shapes on the screen. At 10 mm a pixel, with the map's origin in the middle, at (80, 80).
#include "firmware/view/figure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "firmware/config/profile.hpp"
#include "firmware/view/palette.hpp"
#include "tests/firmware/alert/box_outline.hpp"
#include "tests/firmware/alert/known_object.hpp"

namespace fencepost::test {
namespace {

constexpr view::Window kWindow{{0, 0}, 2};

struct Painted {
  int pixels = 0;
  int left = 1000, right = -1000, top = 1000, bottom = -1000;
};

/// The painted pixels of a shape, by colour.
std::map<std::uint8_t, Painted> painted_by(const console::MapShape& shape) {
  const view::Figure figure = view::make_figure(shape, 3, kWindow);
  std::map<std::uint8_t, Painted> colours;
  for (int y = 0; y < 160; ++y) {
    std::vector<std::uint8_t> pixels(160, view::kGround);
    view::Row row(pixels, y);
    figure.paint(row);
    for (int x = 0; x < 160; ++x) {
      Painted& at = colours[pixels[static_cast<std::size_t>(x)]];
      ++at.pixels;
      at = {at.pixels, std::min(at.left, x), std::max(at.right, x), std::min(at.top, y), std::max(at.bottom, y)};
    }
  }
  return colours;
}

constexpr std::uint8_t kInside = view::kObjects + 3;
constexpr std::uint8_t kEdge = view::kOutlines + 3;

void expect_within(const Painted& painted, int left, int right, int top, int bottom) {
  EXPECT_NEAR(painted.left, left, 1);
  EXPECT_NEAR(painted.right, right, 1);
  EXPECT_NEAR(painted.top, top, 1);
  EXPECT_NEAR(painted.bottom, bottom, 1);
}

// A wall 0.6 m across and 0.1 m deep, its middle 0.3 m ahead and 0.2 m to the left of the map's origin. The figure is
// at (60, 50), 60 pixels wide and 10 high. All four corners are on whole pixels.
TEST(Figure, AnOutlineIsDrawnAsItIs) {
  const BoxOutline wall(0.1F, 0.6F, 0.01F);
  auto colours = painted_by({{300, 200}, 0, wall.view()});
  expect_within(colours[kEdge], 30, 90, 45, 55);
  expect_within(colours[kInside], 31, 89, 46, 54);
  EXPECT_NEAR(colours[kInside].pixels, 59 * 9, 59);
  EXPECT_NEAR(colours[kEdge].pixels, 2 * 61 + 2 * 9, 30);
}

// A fit may give a few directions less than their neighbours leave room for, so that some of those have no edge. What
// is drawn is what all sides enclose: no tail where the sides beside it meet.
TEST(Figure, ASideThatLiesFartherInLeavesNoTail) {
  std::array<std::int16_t, 64> offsets{};
  std::array<std::uint8_t, 64> sigmas{};
  offsets.fill(static_cast<std::int16_t>(std::lround(0.2F / recon::kOffsetStep)));
  sigmas.fill(recon::encode_sigma(0.01F));
  for (const std::size_t k :
       {std::size_t{16}, std::size_t{0}, std::size_t{63}}) {  // left, and on both sides of the seam
    auto dented = offsets;
    dented[k] = static_cast<std::int16_t>(std::lround(0.16F / recon::kOffsetStep));
    auto colours = painted_by({{0, 0}, 0, recon::OutlineView{dented, sigmas}});
    const bool ahead = k != 16;
    expect_within(colours[kEdge], ahead ? 60 : 64, 100, ahead ? 64 : 60, 100);
  }
}

TEST(Figure, ACylinderIsADisc) {
  auto colours = painted_by({{300, 200}, 100, {}});
  expect_within(colours[kInside], 50, 70, 40, 60);
  EXPECT_NEAR(colours[kInside].pixels, 314, 15);  // pi 10^2
  EXPECT_FALSE(colours.contains(kEdge));
}

TEST(Figure, WhatIsSmallIsStillSeen) {
  const BoxOutline post(0.02F, 0.02F, 0.001F);
  for (const console::MapShape& shape :
       {console::MapShape{{300, 200}, 0, post.view()}, console::MapShape{{300, 200}, 5, {}}}) {
    auto colours = painted_by(shape);
    expect_within(colours[kInside], 57, 63, 47, 53);
  }
}

// The choice that the console's map makes, too.
TEST(Figure, AnObjectIsItsOutlineWhereThatIsKnownWellAndElseItsCylinder) {
  recon::Object<config::Small> object;
  static_cast<recon::ObjectCore&>(object) = known_object(1.0, 0.5, 0.1);
  const auto shape = [&object] { return console::shape_of(object); };
  ASSERT_TRUE(shape());
  EXPECT_FALSE(shape()->outlined()) << "there is none";
  EXPECT_NEAR(shape()->middle.x, 1000, 2);
  EXPECT_NEAR(shape()->radius, 100, 2);
  object.hybrid().refusal = recon::HybridRefusal::kNone;
  object.hybrid().origin = {110'000, 50'000};
  for (const float sigma : {0.01F, 0.2F}) {
    const BoxOutline box(0.1F, 0.3F, sigma);
    std::ranges::copy(box.view().offsets, object.hybrid().offsets.begin());
    std::ranges::copy(box.view().sigmas, object.hybrid().sigmas.begin());
    EXPECT_EQ(shape()->outlined(), sigma < 0.1F);
    EXPECT_NEAR(shape()->middle.x, sigma < 0.1F ? 1100 : 1000, 2);
  }
  object.id = 0;
  EXPECT_FALSE(shape());
}

}  // namespace
}  // namespace fencepost::test
