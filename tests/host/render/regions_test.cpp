#include "host/render/regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/scene/load.hpp"
#include "host/simulate/truth.hpp"
#include "tests/host/render/blocks.hpp"

namespace fencepost::host {
namespace {

using testing::block;
using testing::kLens;
using testing::rectangle;

std::vector<std::optional<Region>> render(const std::vector<Solid>& solids, const CameraPose& lens = kLens) {
  return RegionRenderer(testing::small_camera()).render(solids, lens);
}

void expect_box(const std::optional<Region>& region, double left, double top, double right, double bottom) {
  ASSERT_TRUE(region.has_value());
  EXPECT_EQ(region->left, left);
  EXPECT_EQ(region->top, top);
  EXPECT_EQ(region->right, right);
  EXPECT_EQ(region->bottom, bottom);
}

TEST(RegionRenderer, ProjectsTheNearFaceOfABlock) {
  // The face is 1 m ahead, 0.2 m wide and from 0.15 m below the lens to 0.15 m above. That is 40 px by 60 px around the
  // centre.
  const auto regions = render({block(1, -0.1, 1.2, 0.1)});
  expect_box(regions[0], 79.5, 29.5, 119.5, 89.5);
  EXPECT_EQ(regions[0]->pixels, 40 * 60);
  EXPECT_EQ(regions[0]->signature, 1);
  EXPECT_EQ(regions[0]->colour->red, 200);
}

TEST(RegionRenderer, ShowsOnlyWhatNoNearerSolidHides) {
  // At half the distance, from y = 0 to 0.05: hides y = 0..0.1 of the face, the left half of its columns.
  const std::vector<Solid> solids{block(1, -0.1, 1.2, 0.1), block(0.5, 0, 0.52, 0.05)};
  expect_box(render(solids)[0], 99.5, 29.5, 119.5, 89.5);
  const std::vector<Solid> turned{solids[1], solids[0]};
  expect_box(render(turned)[1], 99.5, 29.5, 119.5, 89.5);
}

TEST(RegionRenderer, TakesTheLargestOfSeveralPieces) {
  // A post in front of columns 105 to 109: 25 columns are left on its left side, 10 on its right.
  const auto regions = render({block(1, -0.1, 1.2, 0.1), block(0.5, -0.025, 0.51, -0.0125)});
  expect_box(regions[0], 79.5, 29.5, 104.5, 89.5);
}

TEST(RegionRenderer, ShowsNothingOfWhatIsHiddenOrBehindOrBesideTheImage) {
  EXPECT_FALSE(render({block(1, -0.1, 1.2, 0.1), block(0.5, -1, 0.6, 1)})[0].has_value());
  EXPECT_FALSE(render({block(-1.2, -0.1, -1, 0.1)})[0].has_value());
  EXPECT_FALSE(render({block(1, 2, 1.2, 2.2)})[0].has_value());
}

TEST(RegionRenderer, ShowsNothingOfASliverAtTheBorder) {
  // The right border is y = -0.5 at 1 m. 0.2 m wide, of which 0.05 m (10 px, a quarter) are in the image.
  EXPECT_TRUE(render({block(1, -0.65, 1.0001, -0.45)})[0].has_value());
  // Of 1 m, 0.05 m: 5 % of it.
  EXPECT_FALSE(render({block(1, -1.45, 1.0001, -0.45)})[0].has_value());
  // 2 px wide.
  EXPECT_FALSE(render({block(1, -0.005, 1.01, 0.005)})[0].has_value());
}

TEST(RegionRenderer, LeavesOutASolidAroundTheLens) {
  const auto regions = render({block(-2, -2, 2, 2), block(2.5, -0.1, 2.6, 0.1)});
  EXPECT_FALSE(regions[0].has_value());
  EXPECT_TRUE(regions[1].has_value());
}

TEST(RegionRenderer, LeavesOutWhatHasNoHeightOrNoArea) {
  Solid flat = block(1, -0.1, 1.2, 0.1);
  flat.z_max = flat.z_min;
  Solid nothing;
  nothing.z_max = 1;
  const auto regions = render({flat, nothing, block(1.5, -0.1, 1.6, 0.1)});
  EXPECT_FALSE(regions[0].has_value());
  EXPECT_FALSE(regions[1].has_value());
  EXPECT_TRUE(regions[2].has_value());
}

TEST(RegionRenderer, JoinsTheTouchingPartsOfOneSolid) {
  Solid two = block(1, -0.1, 1.2, 0);
  two.footprint.push_back(rectangle(1, 0, 1.2, 0.1));
  expect_box(render({two})[0], 79.5, 29.5, 119.5, 89.5);
}

TEST(RegionRenderer, RefusesMoreSolidsThanItCanTellApart) {
  EXPECT_THROW(render(std::vector<Solid>(257)), std::length_error);
}

TEST(RegionRenderer, SeesTheTrueWorldAsTheSimulatorDoes) {
  const LoadedScene loaded = load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/blocks_arc.json");
  ASSERT_TRUE(loaded.ok());
  Scene scene = loaded.value();
  scene.noise = {};
  std::vector<Solid> solids;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) solids.push_back(solid_of(scene, i));
  RegionRenderer renderer(scene.camera);
  std::size_t compared = 0;
  const auto compare = [&](const FrameTruth& truth) {
    const auto regions = renderer.render(solids, lens_at(scene.camera, truth.pose));
    for (std::size_t b = 0; b < truth.blobs.size(); ++b) {
      const BlobTruth& blob = truth.blobs[b];
      const auto same = std::count_if(truth.blobs.begin(), truth.blobs.end(),
                                      [&](const BlobTruth& other) { return other.object == blob.object; });
      if (same != 1 || !blob.others.empty() || !regions[*blob.object]) continue;
      const Region seen = region_of(truth.frame.blobs[b]);
      expect_box(regions[*blob.object], seen.left, seen.top, seen.right, seen.bottom);
      EXPECT_EQ(regions[*blob.object]->pixels, seen.pixels);
      ++compared;
    }
  };
  ASSERT_TRUE(simulate_with_truth(
                  scene, [](std::string_view) {}, compare)
                  .ok());
  EXPECT_GT(compared, 100U);
}

TEST(LensAt, StandsWhereTheMountPutsIt) {
  sensor::CameraIntrinsics camera = testing::small_camera();
  camera.mount.x = base::Metres::nearest(0.1);
  camera.mount.y = base::Metres::nearest(0.02);
  camera.mount.yaw = base::Radians::nearest(0.5);
  const CameraPose lens = lens_at(camera, {0, 3, 4, 1.5707963267948966});  // robot looks along y
  EXPECT_NEAR(lens.x, 2.98, 1e-12);
  EXPECT_NEAR(lens.y, 4.1, 1e-12);
  EXPECT_NEAR(lens.z, 0.15, 1e-12);
  EXPECT_NEAR(lens.heading, 2.0707963267948966, 1e-12);
}

}  // namespace
}  // namespace fencepost::host
