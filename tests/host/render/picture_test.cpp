#include "host/render/picture.hpp"

#include <gtest/gtest.h>

#include "host/simulate/optics.hpp"
#include "host/simulate/render.hpp"
#include "tests/host/render/blocks.hpp"

namespace fencepost::host {
namespace {

using testing::block;
using testing::kLens;

constexpr sensor::Rgb kRed{200, 40, 40};
constexpr sensor::Rgb kBlue{40, 70, 190};
constexpr sensor::Rgb kWhite{255, 255, 255};

PictureView view(int scale = 1) { return {testing::small_camera(), kLens, 0, scale}; }

std::size_t count(const Picture& picture, sensor::Rgb colour) {
  std::size_t pixels = 0;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) pixels += picture.at(u, v) == colour ? 1U : 0U;
  }
  return pixels;
}

TEST(DrawPicture, SegmentsSolidsInFlatColourOnWhite) {
  const std::vector<Solid> solids{block(1, -0.1, 1.2, 0.1)};
  const Picture picture = draw_picture(solids, view(), PictureStyle::kSegmented);
  ASSERT_EQ(picture.width, 200);
  ASSERT_EQ(picture.height, 120);
  // 40 px by 60 px around (99.5, 59.5).
  EXPECT_EQ(picture.at(100, 60), kRed);
  EXPECT_EQ(picture.at(82, 32), kRed);
  EXPECT_EQ(picture.at(76, 60), kWhite);
  EXPECT_EQ(picture.at(100, 26), kWhite);
  EXPECT_EQ(count(picture, kRed) + count(picture, kWhite), 200U * 120U);
}

TEST(DrawPicture, PaintsTheNearerSolidOverTheFartherOne) {
  const Solid far = block(1, -0.1, 1.2, 0.1, kRed);
  const Solid near = block(0.5, 0, 0.52, 0.05, kBlue);
  for (const std::vector<Solid>& solids : {std::vector<Solid>{far, near}, std::vector<Solid>{near, far}}) {
    const Picture picture = draw_picture(solids, view(), PictureStyle::kSegmented);
    EXPECT_EQ(picture.at(90, 60), kBlue);
    EXPECT_EQ(picture.at(110, 60), kRed);
  }
}

TEST(DrawPicture, EnlargesEachPixelOfTheCamera) {
  const std::vector<Solid> solids{block(1, -0.1, 1.2, 0.1)};
  const Picture picture = draw_picture(solids, view(4), PictureStyle::kSegmented);
  EXPECT_EQ(picture.width, 800);
  EXPECT_NEAR(static_cast<double>(count(picture, kRed)), 16.0 * 40 * 60, 2 * 4 * (40 + 60));
}

TEST(DrawPicture, CoversThePixelsThatTheRaysMeet) {
  // An L seen obliquely from above its lid, and a block that it half hides.
  Solid ell = block(0, 0, 1, 1);
  ell.footprint = {{{{0.8, -0.15}, {1.0, -0.15}, {1.0, -0.05}, {0.9, -0.05}, {0.9, 0.1}, {0.8, 0.1}}, {}}};
  ell.z_max = 0.1;
  const std::vector<Solid> solids{ell, block(1.3, -0.2, 1.5, 0.25, kBlue)};
  const Picture picture = draw_picture(solids, view(), PictureStyle::kSegmented);
  LabelImage labels(200, 120);
  labels.render({{"", 0, 0, 0.1, ell.footprint[0]}, {"", 0, 0, 0.3, solids[1].footprint[0]}},
                PixelRays(testing::small_camera(), 0), kLens);
  int differing = 0;
  int covered = 0;
  for (int v = 0; v < 120; ++v) {
    for (int u = 0; u < 200; ++u) {
      const std::int16_t label = labels.at(u, v);
      const sensor::Rgb expected = label < 0 ? kWhite : label == 0 ? kRed : kBlue;
      differing += picture.at(u, v) == expected ? 0 : 1;
      covered += label < 0 ? 0 : 1;
    }
  }
  EXPECT_GT(covered, 4000);
  EXPECT_LT(differing, 500);  // about a pixel along each side
}

TEST(DrawPicture, LooksDownByThePitch) {
  // The middle of the image is where a ray 45 degrees down meets the floor: 0.15 m ahead of the lens.
  PictureView down = view();
  down.pitch = 0.7853981633974483;
  Solid tile = block(0.14, -0.01, 0.16, 0.01);
  tile.z_max = 1e-6;
  const std::vector<Solid> solids{tile};
  const Picture picture = draw_picture(solids, down, PictureStyle::kSegmented);
  EXPECT_EQ(picture.at(99, 59), kRed);
  EXPECT_EQ(picture.at(99, 20), kWhite);
  EXPECT_EQ(picture.at(99, 100), kWhite);
}

TEST(DrawPicture, ShadesWallsByWhereTheyLook) {
  // Seen at a corner: two walls, two brightnesses of one hue, on a floor under a wall.
  Solid corner = block(0, 0, 1, 1);
  corner.footprint = {{{{0.8, 0}, {1, -0.2}, {1.2, 0}, {1, 0.2}}, {}}};
  const std::vector<Solid> solids{corner};
  const Picture picture = draw_picture(solids, view(), PictureStyle::kShaded);
  const sensor::Rgb left = picture.at(80, 60);
  const sensor::Rgb right = picture.at(120, 60);
  EXPECT_NE(left, right);
  EXPECT_NEAR(double(left.red) / left.green, 5, 0.3);
  EXPECT_NEAR(double(right.red) / right.green, 5, 0.3);
  EXPECT_NE(picture.at(5, 5), picture.at(5, 115));  // wall, floor
}

TEST(DrawPicture, PaintsTheNearerWallOfOneSolidOverItsFartherOnes) {
  const std::vector<Solid> alone{block(0.8, -0.05, 0.9, 0.05)};
  std::vector<Solid> both = alone;
  both[0].footprint.push_back({{{1, 0}, {1.2, -0.2}, {1.4, 0}, {1.2, 0.2}}, {}});  // looks elsewhere: another shade
  const sensor::Rgb near = draw_picture(alone, view(), PictureStyle::kShaded).at(100, 60);
  const Picture picture = draw_picture(both, view(), PictureStyle::kShaded);
  EXPECT_EQ(picture.at(100, 60), near);
  EXPECT_NE(picture.at(125, 60), near);
  std::swap(both[0].footprint[0], both[0].footprint[1]);
  EXPECT_EQ(draw_picture(both, view(), PictureStyle::kShaded).at(100, 60), near);
}

TEST(DrawPicture, LeavesOutWhatEnclosesTheLensAndWhatIsBehindIt) {
  const std::vector<Solid> solids{block(-2, -2, 2, 2), block(-1.2, -0.1, -1, 0.1)};
  EXPECT_EQ(count(draw_picture(solids, view(), PictureStyle::kSegmented), kWhite), 200U * 120U);
}

TEST(DrawPicture, CutsWhatReachesBehindTheLens) {
  // A long wall beside the lens, from behind it to 2 m ahead: its near end fills the image's left border.
  const std::vector<Solid> solids{block(-1, 0.3, 2, 0.4)};
  const Picture picture = draw_picture(solids, view(), PictureStyle::kSegmented);
  EXPECT_EQ(picture.at(0, 60), kRed);
  EXPECT_EQ(picture.at(60, 60), kRed);  // 0.39 right of centre a metre: y = 0.3 at 1.5 m
  EXPECT_EQ(picture.at(90, 60), kWhite);
}

TEST(DrawBox, FramesARegionOfTheCamerasImage) {
  Picture picture = draw_picture({}, view(2), PictureStyle::kSegmented);
  draw_box(picture, view(2), {79.5, 29.5, 119.5, 89.5, 0, 0, std::nullopt}, kRed);
  // Camera column 79.5 is at (79.5 + 0.5) * 2 - 0.5 = 159.5 of the picture.
  EXPECT_EQ(picture.at(160, 120), kRed);
  EXPECT_EQ(picture.at(200, 60), kRed);
  EXPECT_EQ(picture.at(200, 120), kWhite);
  Picture dashed = draw_picture({}, view(2), PictureStyle::kSegmented);
  draw_box(dashed, view(2), {79.5, 29.5, 119.5, 89.5, 0, 0, std::nullopt}, kRed, true);
  EXPECT_GT(count(dashed, kRed), count(picture, kRed) / 4);
  EXPECT_LT(count(dashed, kRed), count(picture, kRed) * 3 / 4);
}

}  // namespace
}  // namespace fencepost::host
