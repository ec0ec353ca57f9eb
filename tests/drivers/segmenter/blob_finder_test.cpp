#include "drivers/segmenter/blob_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace fencepost::segmenter {
namespace {

using Image = std::vector<std::vector<std::uint8_t>>;

/// A digit is a pixel of that signature, anything else background.
Image image_of(const std::vector<std::string>& rows) {
  Image image;
  for (const std::string& row : rows) {
    auto& pixels = image.emplace_back();
    for (const char c : row) pixels.push_back(c >= '1' && c <= '9' ? static_cast<std::uint8_t>(c - '0') : 0);
  }
  return image;
}

sensor::BlobFrame find(const Image& image, const BlobRules& rules) {
  BlobFinder finder(rules);
  finder.begin();
  for (const auto& row : image) finder.add_row(row);
  return finder.finish();
}

using Box = std::tuple<int, int, int, int, int, int>;  // signature, x1, y1, x2, y2, pixels

Box box_of(const sensor::Blob& blob) {
  return {blob.signature, blob.x1, blob.y1, blob.x2, blob.y2, static_cast<int>(blob.pixels)};
}

std::vector<Box> boxes(const std::vector<std::string>& rows, const BlobRules& rules = {1, 0}) {
  std::vector<Box> all;
  for (const sensor::Blob& blob : find(image_of(rows), rules).blobs) all.push_back(box_of(blob));
  return all;
}

TEST(BlobFinder, BoundsOneBoxInclusively) {
  const sensor::BlobFrame frame = find(image_of({"......", "..33..", "..33..", "..3...", "......"}), {1, 0});
  ASSERT_EQ(frame.blobs.size(), 1U);
  EXPECT_EQ(box_of(frame.blobs[0]), Box(3, 2, 1, 3, 3, 5));
  // Columns 2, 3, 2, 3, 2 and rows 1, 1, 2, 2, 3: 12 / 5 = 2.4 and 9 / 5 = 1.8.
  EXPECT_EQ(frame.blobs[0].cx.raw, 24);
  EXPECT_EQ(frame.blobs[0].cy.raw, 18);
  EXPECT_FALSE(frame.blobs[0].rgb.has_value());
  EXPECT_FALSE(frame.blobs[0].bearing);
}

TEST(BlobFinder, AnEmptyImageHasNone) {
  EXPECT_TRUE(boxes({"....", "...."}).empty());
  EXPECT_TRUE(boxes({}).empty());
}

TEST(BlobFinder, UnitesWhatMeetsBelow) {
  EXPECT_EQ(boxes({"1...1", "1...1", "11111"}), (std::vector<Box>{{1, 0, 0, 4, 2, 9}}));
  EXPECT_EQ(boxes({"1.1.1.1", "1.1.1.1", "111.111", "..111.."}), (std::vector<Box>{{1, 0, 0, 6, 3, 17}}));
}

TEST(BlobFinder, UnitesTheOuterOfThreeAroundTheInner) {
  // The outer two meet below the inner one, of another signature, which ends before.
  EXPECT_EQ(boxes({"1.......1", "1..222..1", "1.......1", "111111111"}),
            (std::vector<Box>{{1, 0, 0, 8, 3, 15}, {2, 3, 1, 5, 1, 3}}));
  // Of the same signature it lies within the other's box, and so is a part of it.
  EXPECT_EQ(boxes({"1.......1", "1..111..1", "1.......1", "111111111"}), (std::vector<Box>{{1, 0, 0, 8, 3, 18}}));
}

TEST(BlobFinder, ConnectsDiagonals) {
  EXPECT_EQ(boxes({"1..", ".1.", "..1"}), (std::vector<Box>{{1, 0, 0, 2, 2, 3}}));
  EXPECT_EQ(boxes({"..1", ".1.", "1.."}), (std::vector<Box>{{1, 0, 0, 2, 2, 3}}));
  EXPECT_EQ(boxes({"1.1", "...", "1.1"}).size(), 4U);
}

TEST(BlobFinder, KeepsSignaturesApart) {
  EXPECT_EQ(boxes({"1122", "1122", "1111"}), (std::vector<Box>{{1, 0, 0, 3, 2, 8}, {2, 2, 0, 3, 1, 4}}));
}

TEST(BlobFinder, DropsSmallRegions) {
  EXPECT_EQ(boxes({"11..1", "11..1"}, {3, 0}), (std::vector<Box>{{1, 0, 0, 1, 1, 4}}));
  EXPECT_EQ(boxes({"11..1", "11..1"}, {2, 0}).size(), 2U);
}

TEST(BlobFinder, MergesAcrossAGap) {
  const std::vector<std::string> split = {"11..11", "11..11"};
  EXPECT_EQ(boxes(split, {1, 1}).size(), 2U);
  EXPECT_EQ(boxes(split, {1, 2}), (std::vector<Box>{{1, 0, 0, 5, 1, 8}}));
  EXPECT_EQ(boxes({"11..22", "11..22"}, {1, 2}).size(), 2U) << "of two signatures";
  // Small regions are noise, even beside a large one.
  EXPECT_EQ(boxes({"11.1", "11.."}, {2, 1}), (std::vector<Box>{{1, 0, 0, 1, 1, 4}}));
}

TEST(BlobFinder, MergesOnWhatWasMergedReaches) {
  // The last two make a box whose corner comes near to the first, which is near to neither.
  const std::vector<std::string> three = {"1......", ".......", "..111..", ".......", "....1..", "....1.."};
  EXPECT_EQ(boxes({"11.....", "11.....", ".......", ".......", ".......", "....111"}, {1, 1}).size(), 2U);
  EXPECT_EQ(boxes(three, {1, 1}), (std::vector<Box>{{1, 0, 0, 4, 5, 6}}));
}

TEST(BlobFinder, KeepsTheLargestSixteen) {
  Image image(1, std::vector<std::uint8_t>(200, 0));
  // Seventeen runs of 1 to 17 pixels.
  std::size_t at = 0;
  for (std::size_t size = 1; size <= 17; ++size) {
    std::fill_n(image[0].begin() + static_cast<std::ptrdiff_t>(at), size, std::uint8_t{5});
    at += size + 1;
  }
  BlobFinder finder({1, 0});
  finder.begin();
  finder.add_row(image[0]);
  const sensor::BlobFrame frame = finder.finish();
  ASSERT_EQ(frame.blobs.size(), 16U);
  EXPECT_EQ(frame.blobs[0].pixels, 17U);
  EXPECT_EQ(frame.blobs[15].pixels, 2U);
  EXPECT_EQ(finder.dropped(), 1U);
}

TEST(BlobFinder, AFullRowOfSinglePixelsIsNoOverflow) {
  // Each pixel of another signature than its neighbours, in each row: as many runs and regions as pixels.
  Image image(4, std::vector<std::uint8_t>(BlobFinder::kMaxWidth));
  for (std::size_t v = 0; v < image.size(); ++v) {
    for (std::size_t u = 0; u < image[v].size(); ++u) {
      image[v][u] = static_cast<std::uint8_t>(1 + (u + 3 * v) % 7);
    }
  }
  BlobFinder finder({1, 0});
  finder.begin();
  for (const auto& row : image) finder.add_row(row);
  EXPECT_EQ(finder.finish().blobs.size(), 16U);
  EXPECT_GT(finder.dropped(), 1'000U);
}

TEST(BlobFinder, ForgetsTheImageBefore) {
  BlobFinder finder({1, 0});
  finder.begin();
  finder.add_row(std::vector<std::uint8_t>{1, 1, 1});
  finder.begin();
  finder.add_row(std::vector<std::uint8_t>{0, 0, 2});
  const sensor::BlobFrame frame = finder.finish();
  ASSERT_EQ(frame.blobs.size(), 1U);
  EXPECT_EQ(box_of(frame.blobs[0]), Box(2, 2, 0, 2, 0, 1));
}

// ---- against a flood fill, which knows no runs and no rows

struct Filled {
  Box box;
  std::uint64_t sum_u = 0;
  std::uint64_t sum_v = 0;
};

Filled flood(Image& image, std::size_t u0, std::size_t v0) {
  const std::uint8_t signature = image[v0][u0];
  const int height = static_cast<int>(image.size());
  const int width = static_cast<int>(image[0].size());
  std::vector<std::pair<int, int>> open = {{static_cast<int>(u0), static_cast<int>(v0)}};
  image[v0][u0] = 0;
  Filled filled{{signature, width, height, -1, -1, 0}};
  auto& [s, x1, y1, x2, y2, pixels] = filled.box;
  while (!open.empty()) {
    const auto [u, v] = open.back();
    open.pop_back();
    x1 = std::min(x1, u);
    y1 = std::min(y1, v);
    x2 = std::max(x2, u);
    y2 = std::max(y2, v);
    ++pixels;
    filled.sum_u += static_cast<std::uint64_t>(u);
    filled.sum_v += static_cast<std::uint64_t>(v);
    for (int y = std::max(0, v - 1); y <= std::min(height - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(width - 1, u + 1); ++x) {
        auto& pixel = image[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
        if (pixel != signature) continue;
        pixel = 0;
        open.emplace_back(x, y);
      }
    }
  }
  return filled;
}

bool near(const Box& a, const Box& b, int gap) {
  const auto& [sa, ax1, ay1, ax2, ay2, ap] = a;
  const auto& [sb, bx1, by1, bx2, by2, bp] = b;
  return sa == sb && ax1 - bx2 - 1 <= gap && bx1 - ax2 - 1 <= gap && ay1 - by2 - 1 <= gap && by1 - ay2 - 1 <= gap;
}

std::vector<Box> regions_of(Image image, std::uint32_t min_pixels) {
  std::vector<Box> all;
  for (std::size_t v = 0; v < image.size(); ++v) {
    for (std::size_t u = 0; u < image[v].size(); ++u) {
      if (image[v][u] == 0) continue;
      const Filled filled = flood(image, u, v);
      if (static_cast<std::uint32_t>(std::get<5>(filled.box)) >= min_pixels) all.push_back(filled.box);
    }
  }
  return all;
}

std::vector<Box> merged(std::vector<Box> all, int max_gap) {
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < all.size() && !changed; ++i) {
      for (std::size_t k = i + 1; k < all.size() && !changed; ++k) {
        if (!near(all[i], all[k], max_gap)) continue;
        auto& [s, x1, y1, x2, y2, pixels] = all[i];
        const auto& [so, ox1, oy1, ox2, oy2, opixels] = all[k];
        x1 = std::min(x1, ox1);
        y1 = std::min(y1, oy1);
        x2 = std::max(x2, ox2);
        y2 = std::max(y2, oy2);
        pixels += opixels;
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
        changed = true;
      }
    }
  }
  return all;
}

TEST(BlobFinder, FindsWhatAFloodFillFinds) {
  std::mt19937 random(3);
  int compared = 0;
  for (int round = 0; round < 3'000; ++round) {
    const std::size_t width = 1 + random() % 40;
    const std::size_t height = 1 + random() % 30;
    const std::size_t signatures = 1 + random() % 3;
    const std::size_t filled = 1 + random() % 99;  // per cent
    Image image(height, std::vector<std::uint8_t>(width));
    for (auto& row : image) {
      for (auto& pixel : row) {
        pixel = random() % 100 < filled ? static_cast<std::uint8_t>(1 + random() % signatures) : std::uint8_t{0};
      }
    }
    const BlobRules rules{static_cast<std::uint32_t>(1 + random() % 6), static_cast<std::uint16_t>(random() % 3)};
    std::vector<Box> expected = regions_of(image, rules.min_pixels);
    if (expected.size() > 64) continue;  // more than are kept
    expected = merged(std::move(expected), rules.max_gap);
    std::vector<Box> found;
    for (const sensor::Blob& blob : find(image, rules).blobs) found.push_back(box_of(blob));
    if (expected.size() > sensor::kMaxBlobs) {
      ASSERT_EQ(found.size(), sensor::kMaxBlobs);
      std::vector<int> sizes;
      for (const Box& box : expected) sizes.push_back(std::get<5>(box));
      std::sort(sizes.rbegin(), sizes.rend());
      for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(std::get<5>(found[i]), sizes[i]) << round;
      continue;
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found, expected) << "round " << round;
    ++compared;
  }
  EXPECT_GT(compared, 1'000);
}

TEST(BlobFinder, MeansAreThoseOfTheFloodFill) {
  std::mt19937 random(4);
  for (int round = 0; round < 20; ++round) {
    Image image(480, std::vector<std::uint8_t>(640));
    const std::size_t left = random() % 500;
    const std::size_t top = random() % 400;
    for (std::size_t v = top; v < top + 80; ++v) {
      for (std::size_t u = left; u < left + 140; ++u) image[v][u] = random() % 4 == 0 ? 0 : 1;
    }
    const sensor::BlobFrame frame = find(image, {1'000, 0});
    ASSERT_EQ(frame.blobs.size(), 1U);
    Filled largest;
    for (std::size_t v = top; v < top + 80; ++v) {
      for (std::size_t u = left; u < left + 140; ++u) {
        if (image[v][u] == 0) continue;
        const Filled filled = flood(image, u, v);
        if (std::get<5>(filled.box) > std::get<5>(largest.box)) largest = filled;
      }
    }
    const double pixels = std::get<5>(largest.box);
    EXPECT_NEAR(frame.blobs[0].cx.to_double(), static_cast<double>(largest.sum_u) / pixels, 0.05001);
    EXPECT_NEAR(frame.blobs[0].cy.to_double(), static_cast<double>(largest.sum_v) / pixels, 0.05001);
  }
}

}  // namespace
}  // namespace fencepost::segmenter
