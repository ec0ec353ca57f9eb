#include "host/paper/blocks_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include <set>

#include "host/geometry/planar.hpp"
#include "host/scene/load.hpp"

namespace fencepost::host {
namespace {

using enum BlocksWorld;

TEST(BlocksWorld, IsTheSameForTheSameSeed) {
  for (const BlocksWorld kind : {kFigures, kPaperLike, kDistractor, kHard}) {
    EXPECT_EQ(write_scene(blocks_world(kind, 7)), write_scene(blocks_world(kind, 7)));
    EXPECT_NE(write_scene(blocks_world(kind, 7)), write_scene(blocks_world(kind, 8)));
  }
}

TEST(BlocksWorld, CanBeReadAsAScene) {
  for (const BlocksWorld kind : {kFigures, kPaperLike, kDistractor, kHard}) {
    const LoadedScene loaded = parse_scene(write_scene(blocks_world(kind, 3)), "scene");
    EXPECT_TRUE(loaded.ok()) << loaded.error().message();
  }
}

TEST(BlocksWorld, HasItsBlocksApartBelowTheSkyAndAboveTheLens) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Scene scene = blocks_world(kHard, seed);
    ASSERT_GE(scene.objects.size(), block_count(kHard)) << seed;
    for (std::size_t a = 0; a < block_count(kHard); ++a) {
      const SceneObject& block = scene.objects[a];
      EXPECT_GT(block.height_m, scene.camera.mount.z.to_double());
      EXPECT_GT(area(block.footprint), 0.0005) << seed;
      EXPECT_EQ(block.base, 0);
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_EQ(intersection_area({block.footprint}, {scene.objects[b].footprint}), 0) << seed;
      }
    }
  }
}

TEST(BlocksWorld, GivesTheDistractorALandmarksColour) {
  std::set<int> distractors;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = blocks_world(kDistractor, seed);
    distractors.insert(scene.objects[3].signature);
    EXPECT_EQ(scene.objects[kRedLandmark].signature, 1);
    EXPECT_EQ(scene.objects[kYellowLandmark].signature, 2);
    EXPECT_EQ(scene.objects[2].signature, 3);
  }
  EXPECT_EQ(distractors, (std::set<int>{1, 2}));
}

TEST(BlocksWorld, HasBackgroundInTheLandmarksHuesOnlyWhereItIsHard) {
  const auto landmark_hued = [](const Scene& scene) {
    int count = 0;
    for (const SceneSignature& signature : scene.signatures) {
      if (signature.id < 10) continue;
      const double most = std::max({signature.rgb.red, signature.rgb.green, signature.rgb.blue});
      const double least = std::min({signature.rgb.red, signature.rgb.green, signature.rgb.blue});
      count += (most - least) / most > 0.7 ? 1 : 0;
    }
    return count;
  };
  int paper_like = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(landmark_hued(blocks_world(kHard, seed)), 5) << seed;  // panels 1, 4, 7, 10, 13 of 14
    paper_like += landmark_hued(blocks_world(kPaperLike, seed));
  }
  EXPECT_LE(paper_like, 4);  // of 160
}

TEST(BlocksWorld, IsTheSameWorldWithoutNoise) {
  Scene noisy = blocks_world(kFigures, 5);
  const Scene ideal = blocks_world(kFigures, 5, false);
  EXPECT_GT(noisy.noise.edge_px, 0);
  EXPECT_EQ(ideal.noise.edge_px, 0);
  noisy.noise = {};
  EXPECT_EQ(write_scene(noisy), write_scene(ideal));
}

}  // namespace
}  // namespace fencepost::host
