// Labels drawn by hand: each letter of a picture is one label, '.' the background.
#include "host/segment/regions.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

cv::Mat drawn(const std::vector<std::string>& rows) {
  cv::Mat labels(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), CV_8U);
  for (int v = 0; v < labels.rows; ++v) {
    for (int u = 0; u < labels.cols; ++u) {
      const char c = rows[static_cast<std::size_t>(v)][static_cast<std::size_t>(u)];
      labels.at<std::uint8_t>(v, u) = static_cast<std::uint8_t>(c == '.' ? 0 : c - 'a' + 1);
    }
  }
  return labels;
}

Regions found(const cv::Mat& labels, const RegionRules& rules) {
  return find_regions(labels, canvas(labels.cols, labels.rows, kGrey), rules);
}

constexpr RegionRules kPlain{1, 0, 0};

TEST(Regions, HaveTheirExactBoxesLargestFirst) {
  const Regions regions = found(drawn({"............",  //
                                       ".aa....bbbb.",  //
                                       ".aa....bbbb.",  //
                                       ".......bbbb.",  //
                                       "............"}),
                                kPlain);
  ASSERT_EQ(regions.kept.size(), 2U);
  EXPECT_EQ(regions.kept[0].label, 2);
  expect_box(to_blob(regions.kept[0]), 7, 1, 10, 3);
  expect_box(to_blob(regions.kept[1]), 1, 1, 2, 2);
  EXPECT_EQ(regions.kept[0].pixels, 12U);
}

TEST(Regions, CentroidAndColourAreMeansOverThePixels) {
  cv::Mat image = canvas(6, 6, kGrey);
  paint(image, 1, 1, 1, 3, {90, 0, 10});
  paint(image, 2, 3, 2, 3, {50, 40, 30});
  // An L of four pixels: columns 1, 1, 1, 2; rows 1, 2, 3, 3.
  const Regions regions =
      find_regions(drawn({"......", ".a....", ".a....", ".aa...", "......", "......"}), image, kPlain);
  ASSERT_EQ(regions.kept.size(), 1U);
  const sensor::Blob blob = to_blob(regions.kept[0]);
  EXPECT_NEAR(blob.cx.to_double(), 1.25, 0.051) << "one decimal";
  EXPECT_NEAR(blob.cy.to_double(), 2.25, 0.051);
  EXPECT_EQ(blob.pixels, 4U);
  EXPECT_EQ(blob.rgb, (sensor::Rgb{80, 10, 15}));
}

TEST(Regions, TouchingOnesOfOneSignatureAreOneAlsoAcrossCorners) {
  for (const std::vector<std::string>& rows :
       {std::vector<std::string>{"......", ".aa...", ".aaaa.", "...aa.", "......"},
        std::vector<std::string>{"......", ".aa...", "...aa.", "......"},
        std::vector<std::string>{"......", "...aa.", ".aa...", "......"}}) {
    const Regions regions = found(drawn(rows), kPlain);
    EXPECT_EQ(regions.kept.size(), 1U);
    EXPECT_EQ(regions.merged, 0U) << "they are connected, there is no gap to bridge";
  }
  EXPECT_EQ(found(drawn({"......", ".aabb.", ".aabb.", "......"}), kPlain).kept.size(), 2U);
}

TEST(Regions, ARingIsOneWithItsOuterBox) {
  const Regions regions = found(drawn({".......", ".aaaaa.", ".a...a.", ".a...a.", ".aaaaa.", "......."}), kPlain);
  ASSERT_EQ(regions.kept.size(), 1U);
  expect_box(to_blob(regions.kept[0]), 1, 1, 5, 4);
  EXPECT_EQ(regions.kept[0].pixels, 14U);
}

TEST(Regions, SmallOnesAreDroppedAndCounted) {
  const Regions regions = found(drawn({"a.......", "....aaa.", "a...aaa.", "........"}), {4, 0, 0});
  ASSERT_EQ(regions.kept.size(), 1U);
  EXPECT_EQ(regions.small, 2U);
}

TEST(Regions, PiecesWithANarrowGapAreOne) {
  const cv::Mat labels = drawn({"aaaa..aaaa...aaa",  //
                                "aaaa..aaaa...aaa",  //
                                "aaaa..aaaa...aaa"});
  const Regions regions = found(labels, {1, 2, 0});
  ASSERT_EQ(regions.kept.size(), 2U);
  EXPECT_EQ(regions.merged, 1U);
  expect_box(to_blob(regions.kept[0]), 0, 0, 9, 2);
  EXPECT_EQ(regions.kept[0].pixels, 24U);
  EXPECT_EQ(found(labels, {1, 1, 0}).kept.size(), 3U);
  EXPECT_EQ(found(labels, {1, 3, 0}).kept.size(), 1U) << "three pieces become one, one after the other";
}

TEST(Regions, PiecesMergeDownwardsToo) {
  const cv::Mat labels = drawn({"aaaa", "aaaa", "....", "aaaa", "aaaa"});
  EXPECT_EQ(found(labels, {1, 1, 0}).kept.size(), 1U);
  EXPECT_EQ(found(labels, {1, 0, 0}).kept.size(), 2U);
}

TEST(Regions, AGapThatAnotherSignatureFillsStays) {
  const Regions regions = found(drawn({"aaaabbaaaa", "aaaabbaaaa", "aaaabbaaaa"}), {1, 2, 0});
  EXPECT_EQ(regions.kept.size(), 3U);
  EXPECT_EQ(regions.merged, 0U);
}

TEST(Regions, AnEndNearTheBorderIsPutOntoIt) {
  const cv::Mat labels = drawn({"...........",  //
                                "...........",  //
                                "...........",  //
                                ".aaaaaa....",  //
                                ".aaaaaa....",  //
                                "...........",  //
                                "..........."});
  const Regions regions = found(labels, {1, 0, 2});
  ASSERT_EQ(regions.kept.size(), 1U);
  expect_box(to_blob(regions.kept[0]), 0, 3, 6, 6);
  expect_box(to_blob(found(labels, {1, 0, 0}).kept[0]), 1, 3, 6, 4);
}

}  // namespace
}  // namespace fencepost::host
