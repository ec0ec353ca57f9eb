// Shapes, painted row by row; each expected picture is drawn by hand.
#include "firmware/view/shapes.hpp"

#include <gtest/gtest.h>

#include "firmware/view/font.hpp"
#include "tests/firmware/view/painted.hpp"

namespace fencepost::test {
namespace {

using Rows = std::vector<std::string>;
using view::Row;

template <class Shape>
Rows picture_of(const Shape& shape, std::size_t width, std::size_t height) {
  return painted(width, height, [&](Row& row) { shape.paint(row); });
}

TEST(Shapes, ABoxHasItsLastRowAndColumn) {
  EXPECT_EQ(picture_of(view::Box{1, 1, 3, 2, 1}, 5, 4), (Rows{".....", ".###.", ".###.", "....."}));
}

// Radius 3: half widths by Pythagoras are 0, 2, 2, 3, 2, 2, 0.
TEST(Shapes, ADiscIsRound) {
  EXPECT_EQ(picture_of(view::Disc{{3, 3}, 3, 1}, 7, 7),
            (Rows{"...#...", ".#####.", ".#####.", "#######", ".#####.", ".#####.", "...#..."}));
}

TEST(Shapes, WhatIsOutsideIsLeftOut) {
  EXPECT_EQ(picture_of(view::Disc{{0, 0}, 2, 1}, 4, 4), (Rows{"###.", "##..", "#...", "...."}));
  EXPECT_EQ(picture_of(view::Disc{{-4000, 4000}, 4000, 1}, 4, 4), (Rows{"....", "....", "....", "...."}));
  EXPECT_EQ(picture_of(view::Box{-9, -9, 90, 90, 1}, 2, 2), (Rows{"##", "##"}));
}

view::Polygon square() {
  view::Polygon polygon;
  for (const view::Point corner : {view::Point{1, 1}, {5, 1}, {5, 4}, {1, 4}}) polygon.add(corner);
  return polygon;
}

TEST(Shapes, APolygonHasAnEdgeAPixelWideAndAnInside) {
  EXPECT_EQ(painted(7, 6, [](Row& row) { square().paint_edges(row, 1); }),
            (Rows{".......", ".#####.", ".#...#.", ".#...#.", ".#####.", "......."}));
  EXPECT_EQ(painted(7, 6, [](Row& row) { square().paint_inside(row, 1); }),
            (Rows{".......", ".#####.", ".#####.", ".#####.", ".#####.", "......."}));
}

// A line that goes two columns a row has no holes.
TEST(Shapes, AFlatEdgeHasNoHoles) {
  view::Polygon line;
  line.add({0, 0});
  line.add({8, 4});
  const Rows rows = painted(9, 5, [&](Row& row) { line.paint_edges(row, 1); });
  for (std::size_t y = 0; y + 1 < rows.size(); ++y) {
    EXPECT_GE(rows[y].rfind('#') + 1, rows[y + 1].find('#')) << rows[y] << " over " << rows[y + 1];
  }
  EXPECT_EQ(rows[0][0], '#');
  EXPECT_EQ(rows[4][8], '#');
}

TEST(Shapes, MoreCornersThanFitAreLeftOut) {
  view::Polygon polygon;
  for (int i = 0; i < 100; ++i) polygon.add(view::point_at(i, i % 2));
  EXPECT_EQ(painted(100, 2, [&](Row& row) { polygon.paint_inside(row, 1); })[1].rfind('#'), view::Polygon::kMax - 1);
}

TEST(Shapes, FarPointsStayWhereProductsFit) {
  EXPECT_EQ(view::point_at(1'000'000, -1'000'000), (view::Point{4000, -4000}));
}

TEST(Font, LettersAreLegible) {
  EXPECT_EQ(picture_of(view::Label{{0, 0}, 1, 1, "Fp"}, 12, 7),
            (Rows{"#####.####..", "#.....#...#.", "#.....#...#.", "####..####..", "#.....#.....", "#.....#.....",
                  "#.....#....."}));
  const Rows large = picture_of(view::Label{{1, 1}, 2, 1, "-"}, 12, 16);
  EXPECT_EQ(large[6], "............");
  EXPECT_EQ(large[7], ".##########.");
  EXPECT_EQ(large[8], ".##########.");
  EXPECT_EQ(large[9], "............");
}

TEST(Font, LettersDifferAndWhatIsMissingIsAQuestionMark) {
  const auto letter = [](char c) { return picture_of(view::Label{{0, 0}, 1, 1, std::string_view(&c, 1)}, 5, 7); };
  const std::string all = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-+.,:/_?";
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(letter(all[i]), letter(all[j])) << all[i] << all[j];
  }
  EXPECT_EQ(letter('q'), letter('Q'));
  EXPECT_EQ(letter('\xE4'), letter('?'));
  EXPECT_EQ(letter('\x7F'), letter('?'));
}

}  // namespace
}  // namespace fencepost::test
