#include "drivers/segmenter/colour_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace fencepost::segmenter {
namespace {

using bus::PixelLayout;

ColourRange range(std::uint8_t signature, double red_min, double red_max, double green_min, double green_max,
                  std::uint8_t brightness_min = 20) {
  return {signature,
          base::Ratio4::nearest(red_min),
          base::Ratio4::nearest(red_max),
          base::Ratio4::nearest(green_min),
          base::Ratio4::nearest(green_max),
          brightness_min,
          255};
}

// Orange 230, 110, 30 has shares of 0.622 and 0.297; blue 30, 60, 200 has 0.103 and 0.207.
const std::vector<ColourRange> kRanges = {range(1, 0.55, 0.70, 0.23, 0.36), range(2, 0.03, 0.18, 0.14, 0.28)};

TEST(SignatureOf, IsThatOfTheRangeThatHoldsTheShares) {
  EXPECT_EQ(signature_of(kRanges, 230, 110, 30), 1);
  EXPECT_EQ(signature_of(kRanges, 30, 60, 200), 2);
  EXPECT_EQ(signature_of(kRanges, 128, 128, 128), 0);
  EXPECT_EQ(signature_of(kRanges, 255, 255, 255), 0);
  EXPECT_EQ(signature_of(kRanges, 0, 0, 0), 0);
  EXPECT_EQ(signature_of({}, 230, 110, 30), 0);
}

TEST(SignatureOf, BoundsAreInclusive) {
  const std::vector<ColourRange> one = {range(1, 0.5, 0.5, 0.25, 0.25, 40)};
  EXPECT_EQ(signature_of(one, 100, 50, 50), 1);
  EXPECT_EQ(signature_of(one, 101, 50, 50), 0);
  EXPECT_EQ(signature_of(one, 60, 30, 30), 1) << "a mean of 40";
  EXPECT_EQ(signature_of(one, 58, 29, 29), 0);
  std::vector<ColourRange> dim = {range(1, 0, 1, 0, 1, 0)};
  dim[0].brightness_max = 40;
  EXPECT_EQ(signature_of(dim, 41, 40, 41), 1) << "a mean of 40 and 2/3";
  EXPECT_EQ(signature_of(dim, 41, 41, 41), 0);
}

TEST(SignatureOf, TakesTheNearerMiddleOfTwoRanges) {
  // Red shares of 0.40 to 0.60 and 0.50 to 0.90: at 0.57 the first is 0.7 of its half width off, the second 0.65.
  const std::vector<ColourRange> two = {range(1, 0.40, 0.60, 0.0, 0.6), range(2, 0.50, 0.90, 0.0, 0.6)};
  EXPECT_EQ(signature_of(two, 54, 30, 16), 1);
  EXPECT_EQ(signature_of(two, 57, 28, 15), 2);
  const std::vector<ColourRange> same = {two[0], range(3, 0.40, 0.60, 0.0, 0.6)};
  EXPECT_EQ(signature_of(same, 54, 30, 16), 1) << "of equals the first";
}

/// ITU-R BT.601 in double, as its text has it.
std::array<std::uint8_t, 3> yuv_of(double red, double green, double blue, bool full) {
  const double y = 0.299 * red + 0.587 * green + 0.114 * blue;
  const double u = (blue - y) / 1.772;
  const double v = (red - y) / 1.402;
  const auto level = [](double value) { return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L)); };
  if (full) return {level(y), level(128 + u), level(128 + v)};
  return {level(16 + y * 219 / 255), level(128 + u * 224 / 255), level(128 + v * 224 / 255)};
}

std::uint8_t looked_up(const ColourTable& table, int red, int green, int blue) {
  std::vector<std::uint8_t> row;
  if (table.layout() == PixelLayout::kRgb) {
    for (int i = 0; i < 2; ++i) {
      for (const int level : {red, green, blue}) row.push_back(static_cast<std::uint8_t>(level));
    }
  } else {
    const auto yuv = yuv_of(red, green, blue, table.layout() == PixelLayout::kYuyvFull);
    row = {yuv[0], yuv[1], yuv[0], yuv[2]};
  }
  std::array<std::uint8_t, 2> labels{};
  table.look_up(row, labels);
  EXPECT_EQ(labels[0], labels[1]);
  return labels[0];
}

constexpr PixelLayout kLayouts[] = {PixelLayout::kYuyv, PixelLayout::kYuyvFull, PixelLayout::kRgb};

TEST(ColourTable, AnswersAsTheRangesDoInEveryLayout) {
  const auto table = std::make_unique<ColourTable>();
  for (const PixelLayout layout : kLayouts) {
    table->fill(layout, kRanges);
    for (const double light : {1.0, 0.7, 0.4}) {
      const auto lit = [&](int level) { return static_cast<int>(std::lround(level * light)); };
      EXPECT_EQ(looked_up(*table, lit(230), lit(110), lit(30)), 1) << static_cast<int>(layout) << " " << light;
      EXPECT_EQ(looked_up(*table, lit(30), lit(60), lit(200)), 2) << static_cast<int>(layout) << " " << light;
      for (const int grey : {30, 90, 160, 250}) EXPECT_EQ(looked_up(*table, grey, grey, grey), 0) << grey;
    }
  }
}

/// All of the ranges, grown to each side; negative: shrunk.
std::vector<ColourRange> grown(double share, int brightness) {
  std::vector<ColourRange> ranges = kRanges;
  for (ColourRange& one : ranges) {
    const base::Ratio4 by = base::Ratio4::nearest(share);
    one.red_min = one.red_min - by;
    one.red_max = one.red_max + by;
    one.green_min = one.green_min - by;
    one.green_max = one.green_max + by;
    one.brightness_min = static_cast<std::uint8_t>(one.brightness_min - brightness);
  }
  return ranges;
}

TEST(ColourTable, DiffersFromTheRangesOnlyAtTheirBounds) {
  const auto table = std::make_unique<ColourTable>();
  // Half a step of 8, with what limited luma and chroma stretch it by, is 5 levels: of a sum of 300 less than 0.04.
  const std::vector<ColourRange> larger = grown(0.04, 5);
  const std::vector<ColourRange> smaller = grown(-0.04, -5);
  for (const PixelLayout layout : kLayouts) {
    table->fill(layout, kRanges);
    int inside = 0;
    int outside = 0;
    for (int red = 0; red < 256; red += 5) {
      for (int green = 0; green < 256; green += 5) {
        for (int blue = 0; blue < 256; blue += 5) {
          if (red + green + blue < 300) continue;
          const std::uint8_t found = looked_up(*table, red, green, blue);
          const std::uint8_t surely = signature_of(smaller, red, green, blue);
          if (surely != 0) {
            ASSERT_EQ(found, surely) << red << " " << green << " " << blue << " layout " << static_cast<int>(layout);
            ++inside;
          } else if (signature_of(larger, red, green, blue) == 0) {
            ASSERT_EQ(found, 0) << red << " " << green << " " << blue << " layout " << static_cast<int>(layout);
            ++outside;
          }
        }
      }
    }
    EXPECT_GT(inside, 500);
    EXPECT_GT(outside, 50'000);
  }
}

TEST(ColourTable, APairSharesItsChroma) {
  const auto table = std::make_unique<ColourTable>();
  table->fill(PixelLayout::kYuyvFull, kRanges);
  const auto orange = yuv_of(230, 110, 30, true);
  // The second pixel of the pair is too dark.
  const std::vector<std::uint8_t> row = {orange[0], orange[1], 2, orange[2], 0, 128, 0, 128};
  std::array<std::uint8_t, 3> labels{9, 9, 9};
  table->look_up(row, labels);
  EXPECT_EQ(labels, (std::array<std::uint8_t, 3>{1, 0, 0})) << "of an odd number of pixels the last has half a pair";
}

TEST(ColourTable, RowsHaveWholePairs) {
  EXPECT_EQ(row_bytes(PixelLayout::kYuyv, 4), 8U);
  EXPECT_EQ(row_bytes(PixelLayout::kYuyvFull, 3), 8U);
  EXPECT_EQ(row_bytes(PixelLayout::kRgb, 3), 9U);
}

}  // namespace
}  // namespace fencepost::segmenter
