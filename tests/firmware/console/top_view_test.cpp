#include "firmware/console/top_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "firmware/console/map_shape.hpp"
#include "tests/firmware/alert/box_outline.hpp"

namespace fencepost::test {
namespace {

using console::MapExtent;
using console::MapMillimetres;
using console::TopView;
using console::TopViewRow;

struct Disc {
  MapMillimetres center;
  std::int32_t radius;
  char letter;
};

// The rows, line ends and scale cut off.
std::vector<std::string> drawn(const std::vector<Disc>& discs, MapMillimetres robot, double degrees, TopView* used) {
  MapExtent extent;
  extent.include(robot, 0);
  for (const Disc& disc : discs) extent.include(disc.center, disc.radius);
  const TopView view = TopView::of(extent, robot, static_cast<std::int32_t>(std::lround(degrees * 17453.2925)));
  if (used) *used = view;
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < TopView::kRows; ++i) {
    TopViewRow row(view, i);
    for (const Disc& disc : discs) row.disc(disc.center, disc.radius, disc.letter);
    row.robot();
    std::array<char, 128> out{};
    const std::size_t size = row.write(out);
    EXPECT_GE(size, TopView::kMargin + 2);
    EXPECT_LE(size, 79U + 2);
    rows.emplace_back(out.data() + TopView::kMargin, size - TopView::kMargin - 2);
  }
  return rows;
}

// (row, column) of a character, {-1, -1} if it is not there.
std::pair<int, int> place_of(const std::vector<std::string>& rows, char c) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t at = rows[i].find(c);
    if (at != std::string::npos) return {static_cast<int>(i), static_cast<int>(at)};
  }
  return {-1, -1};
}

TEST(TopView, ForwardIsUpAndLeftIsLeft) {
  TopView view;
  const auto rows = drawn({{{900, 450}, 0, 'A'}, {{900, -450}, 0, 'B'}}, {0, 0}, 0, &view);
  const auto robot = place_of(rows, '^');
  const auto a = place_of(rows, 'A');
  const auto b = place_of(rows, 'B');
  // 0.9 m in rows of 0.06 m, 0.45 m in columns of 0.03 m: 15 each.
  EXPECT_EQ(view.row_mm(), 60);
  EXPECT_EQ(robot.first - a.first, 15);
  EXPECT_EQ(robot.second - a.second, 15);
  EXPECT_EQ(b.second - robot.second, 15);
  EXPECT_EQ(a.first, b.first);
}

TEST(TopView, TheArrowAndItsDotsPointAlongTheHeading) {
  const auto around = [](double degrees, char arrow, int rows_up, int columns_left) {
    const auto rows = drawn({}, {0, 0}, degrees, nullptr);
    const auto robot = place_of(rows, arrow);
    ASSERT_GE(robot.first, 0) << degrees;
    const auto row = static_cast<std::size_t>(robot.first - 3 * rows_up);
    const auto column = static_cast<std::size_t>(robot.second - 6 * columns_left);
    ASSERT_LT(column, rows[row].size()) << degrees;
    EXPECT_EQ(rows[row][column], '.') << degrees;
  };
  around(0, '^', 1, 0);
  around(90, '<', 0, 1);
  around(180, 'v', -1, 0);
  around(-90, '>', 0, -1);
  around(360 + 90, '<', 0, 1);
  const auto diagonal = drawn({}, {0, 0}, 45, nullptr);
  const auto arrow = place_of(diagonal, '<');
  EXPECT_EQ(diagonal[static_cast<std::size_t>(arrow.first - 1)][static_cast<std::size_t>(arrow.second - 1)], '.');
  EXPECT_EQ(diagonal[static_cast<std::size_t>(arrow.first - 2)][static_cast<std::size_t>(arrow.second - 4)], '.');
}

TEST(TopView, ADiscIsRoundToTheEyeAndNeverLost) {
  const auto rows = drawn({{{0, 0}, 200, 'A'}, {{1000, 0}, 0, 'B'}}, {-200, 400}, 0, nullptr);
  std::size_t cells = 0;
  std::size_t widest = 0;
  std::size_t height = 0;
  for (const std::string& row : rows) {
    const auto width = static_cast<std::size_t>(std::count(row.begin(), row.end(), 'A'));
    cells += width;
    widest = std::max(widest, width);
    height += width > 0 ? 1 : 0;
  }
  // A cell is a row of 0.08 m by a column of 0.04 m. pi 0.2^2 is 39 cells; the edge cuts 22, and half of them may err.
  EXPECT_NEAR(static_cast<double>(cells), 39, 11);
  EXPECT_EQ(widest, 11U);
  EXPECT_EQ(height, 5U);
  EXPECT_NE(place_of(rows, 'B').first, -1);
}

// A wall 0.6 m wide and 0.1 m deep.
const BoxOutline kWall(0.1F, 0.6F, 0.01F);

TEST(TopView, AChordIsWhatALineCutsFromAnOutline) {
  for (const float x : {-0.049F, 0.0F, 0.03F}) {
    const recon::Chord chord = kWall.view().chord_at(x);
    ASSERT_FALSE(chord.empty()) << x;
    EXPECT_NEAR(chord.low, -0.3F, 1e-3F) << x;
    EXPECT_NEAR(chord.high, 0.3F, 1e-3F) << x;
  }
  EXPECT_TRUE(kWall.view().chord_at(0.051F).empty());
  EXPECT_TRUE(kWall.view().chord_at(-0.2F).empty());
}

TEST(TopView, AnOutlineIsDrawnAsItIsWhereverItStands) {
  for (const MapMillimetres place : {MapMillimetres{600, 0}, MapMillimetres{623, 317}, MapMillimetres{-900, -40}}) {
    MapExtent extent;
    extent.include({0, 0}, 0);
    const console::MapShape shape{place, 0, kWall.view()};
    const MapMillimetres corner = shape.place_of({0.5F, -0.25F});
    EXPECT_EQ(corner.x, place.x + 500);
    EXPECT_EQ(corner.y, place.y - 250);
    EXPECT_EQ(shape.place_of({250, -250}).x, place.x + 100'000) << "no farther is drawn";
    EXPECT_EQ(shape.place_of({250, -250}).y, place.y - 100'000);
    shape.include_in(extent);
    const TopView view = TopView::of(extent, {0, 0}, 0);
    std::size_t rows = 0;
    for (std::size_t i = 0; i < TopView::kRows; ++i) {
      TopViewRow row(view, i);
      shape.draw('W', row);
      std::array<char, 128> out{};
      const std::string text(out.data(), row.write(out));
      const auto width = std::count(text.begin(), text.end(), 'W');
      if (width == 0) continue;
      ++rows;
      // 0.6 m of whole columns; the row of its middle alone may be out of reach of its edge.
      if (width == 1) continue;
      EXPECT_NEAR(static_cast<double>(width) * view.column_mm(), 600, 1.5 * view.column_mm()) << text;
    }
    EXPECT_GE(rows, 1U) << place.x;
    EXPECT_LE(static_cast<std::int32_t>(rows) * view.row_mm(), 100 + 2 * view.row_mm()) << place.x;
  }
}

TEST(TopView, EverythingStaysInTheDrawingAtEveryScale) {
  for (std::int32_t far = 1; far < 1'000'000; far = far * 3 + 1) {
    for (const MapMillimetres robot : {MapMillimetres{0, 0}, MapMillimetres{-far, far}, MapMillimetres{far, -far}}) {
      const auto rows =
          drawn({{{far, far}, 0, 'A'}, {{-far, -far}, 0, 'B'}, {{far, -far / 2}, far / 3, 'C'}}, robot, 30, nullptr);
      EXPECT_NE(place_of(rows, '^').first, -1) << far;
      if (far < 200) continue;  // nearer than a few characters, they cover each other
      EXPECT_NE(place_of(rows, 'C').first, -1) << far;
      EXPECT_NE(place_of(rows, 'B').first, -1) << far;
    }
  }
}

TEST(TopView, FarFromTheOriginTheScaleIsAsFine) {
  TopView view;
  drawn({{{999'900, -999'900}, 50, 'A'}}, {999'000, -999'000}, 0, &view);
  EXPECT_LE(view.row_mm(), 80);
}

}  // namespace
}  // namespace fencepost::test
