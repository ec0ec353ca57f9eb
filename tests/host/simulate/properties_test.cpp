// Properties of any scene.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "tests/host/simulate/recorded.hpp"

namespace fencepost::host {
namespace {

Scene blocks(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Scene scene = empty_scene();
  for (int i = 0; scene.objects.size() < 4; ++i) {
    const double size = 0.08 + 0.04 * uniform(random);
    SceneObject object;
    object.signature = static_cast<std::uint8_t>(1 + i % 3);
    object.height_m = 0.15 + 0.1 * uniform(random);
    object.footprint.outer = {{-size, -size}, {size, -size}, {0.7 * size, size}, {-size, 0.8 * size}};
    object.footprint = moved(object.footprint, 3 * uniform(random), {0.35 * uniform(random), 0.35 * uniform(random)});
    const bool free = std::none_of(scene.objects.begin(), scene.objects.end(), [&](const SceneObject& other) {
      return intersection_area({other.footprint}, {object.footprint}) > 0;
    });
    if (free) scene.objects.push_back(object);
  }
  scene.path = ArcPath{{0, 0}, 1.1, 0.1, 5, 20, false};
  return scene;
}

TEST(Properties, SameSceneSameBytes) {
  Scene scene = blocks(1);
  scene.noise.edge_px = 1;
  scene.noise.false_rate = 0.3;
  scene.noise.drift_walk = 0.01;
  const Simulated first = run(scene);
  EXPECT_EQ(first.log.text, run(scene).log.text);
  scene.seed = 2;
  EXPECT_NE(first.log.text, run(scene).log.text);
}

TEST(Properties, MirroredSceneMirrorsTheBoxes) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Scene scene = blocks(seed);
    Scene mirrored = scene;
    for (SceneObject& object : mirrored.objects) {
      for (Point& p : object.footprint.outer) p.y = -p.y;
      object.footprint = oriented(object.footprint);
    }
    auto& arc = std::get<ArcPath>(mirrored.path);
    arc.start = -arc.start;
    arc.sweep = -arc.sweep;
    const Simulated a = run(scene);
    const Simulated b = run(mirrored);
    ASSERT_EQ(a.log.frames.size(), b.log.frames.size());
    for (std::size_t i = 0; i < a.log.frames.size(); ++i) {
      ASSERT_EQ(a.log.frames[i].blobs.size(), b.log.frames[i].blobs.size());
      std::vector<std::array<int, 6>> left;
      std::vector<std::array<int, 6>> right;
      for (const auto& blob : a.log.frames[i].blobs) {
        left.push_back({blob.signature, blob.x1, blob.x2, blob.y1, blob.y2, static_cast<int>(blob.pixels)});
      }
      for (const auto& blob : b.log.frames[i].blobs) {
        right.push_back(
            {blob.signature, 315 - blob.x2, 315 - blob.x1, blob.y1, blob.y2, static_cast<int>(blob.pixels)});
      }
      std::sort(left.begin(), left.end());
      std::sort(right.begin(), right.end());
      EXPECT_EQ(left, right) << "frame " << i;
      compared += static_cast<int>(left.size());
    }
  }
  EXPECT_GT(compared, 200);
}

TEST(Properties, MovingSceneAndPathTogetherChangesNothing) {
  const Scene scene = blocks(3);
  Scene elsewhere = scene;
  const Point shift{5, -3};
  const double angle = 0.7;
  for (SceneObject& object : elsewhere.objects) object.footprint = moved(object.footprint, angle, shift);
  auto& arc = std::get<ArcPath>(elsewhere.path);
  arc.center = shift;
  arc.start += angle;
  const Simulated a = run(scene);
  const Simulated b = run(elsewhere);
  int differences = 0;  // a ray that passes a corner within rounding may go either way
  for (std::size_t i = 0; i < a.log.frames.size(); ++i) {
    if (!(a.log.frames[i] == b.log.frames[i])) ++differences;
  }
  EXPECT_EQ(a.log.frames.size(), 20U);
  EXPECT_LE(differences, 1);
}

// Objects of one colour that touch in the image are one blob.
Scene each_in_its_own_colour(Scene scene) {
  scene.signatures.clear();
  for (SceneObject& object : scene.objects) {
    object.signature = static_cast<std::uint8_t>(scene.signatures.size() + 1);
    scene.signatures.push_back({object.signature, object.name, {200, 40, 40}});
  }
  return scene;
}

TEST(Properties, TouchingObjectsOfOneColourAreOneBlob) {
  const Simulated apart = run(each_in_its_own_colour(blocks(4)));
  Scene alike = blocks(4);
  for (SceneObject& object : alike.objects) object.signature = 1;
  const Simulated merged = run(alike);
  int several = 0;
  for (std::size_t frame = 0; frame < merged.truth.size(); ++frame) {
    std::uint32_t pixels = 0, pixels_apart = 0;
    for (const sensor::Blob& blob : merged.truth[frame].frame.blobs) pixels += blob.pixels;
    for (const sensor::Blob& blob : apart.truth[frame].frame.blobs) pixels_apart += blob.pixels;
    EXPECT_EQ(pixels, pixels_apart) << "frame " << frame;
    EXPECT_LE(merged.truth[frame].blobs.size(), apart.truth[frame].blobs.size());
    for (const BlobTruth& blob : merged.truth[frame].blobs) several += blob.others.empty() ? 0 : 1;
  }
  EXPECT_GT(several, 0);
}

TEST(Properties, AnObjectNeverGrowsWhenAnotherIsAdded) {
  const Scene all = each_in_its_own_colour(blocks(4));
  Scene fewer = all;
  fewer.objects.pop_back();
  const auto pixels_of = [](const Simulated& simulated, std::size_t frame) {
    std::map<std::size_t, std::uint32_t> pixels;
    for (std::size_t i = 0; i < simulated.truth[frame].blobs.size(); ++i) {
      pixels[*simulated.truth[frame].blobs[i].object] += simulated.truth[frame].frame.blobs[i].pixels;
    }
    return pixels;
  };
  const Simulated with = run(all);
  const Simulated without = run(fewer);
  bool hides_something = false;
  for (std::size_t frame = 0; frame < with.truth.size(); ++frame) {
    const auto more = pixels_of(with, frame);
    const auto before = pixels_of(without, frame);
    for (std::size_t object = 0; object < fewer.objects.size(); ++object) {
      const auto now = more.contains(object) ? more.at(object) : 0;
      const auto then = before.contains(object) ? before.at(object) : 0;
      EXPECT_LE(now, then) << "frame " << frame;
      hides_something = hides_something || now < then;
    }
  }
  EXPECT_TRUE(hides_something) << "the added object hides nothing: the test shows nothing";
}

TEST(Properties, EveryUnobstructedEndIsWithinHalfAPixelOfItsTangent) {
  // The contract between simulator and reconstruction: continuous edges x1 - 0.5 and x2 + 0.5 enclose the object.
  const Scene scene = each_in_its_own_colour(blocks(5));
  const Simulated simulated = run(scene);
  int compared = 0;
  for (const FrameTruth& truth : simulated.truth) {
    for (std::size_t i = 0; i < truth.blobs.size(); ++i) {
      const auto& outline = scene.objects[*truth.blobs[i].object].footprint.outer;
      double least = 1e9;
      double most = -1e9;
      for (const Point p : outline) {
        const double dx = p.x - truth.pose.x;
        const double dy = p.y - truth.pose.y;
        const double c = std::cos(truth.pose.heading);
        const double s = std::sin(truth.pose.heading);
        const double u = 157.5 - 273.6 * (-s * dx + c * dy) / (c * dx + s * dy);
        least = std::min(least, u);
        most = std::max(most, u);
      }
      if (truth.blobs[i].left == BlobEnd::kEdge) {
        EXPECT_NEAR(truth.frame.blobs[i].x1 - 0.5, least, 0.5001);
        ++compared;
      }
      if (truth.blobs[i].right == BlobEnd::kEdge) {
        EXPECT_NEAR(truth.frame.blobs[i].x2 + 0.5, most, 0.5001);
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 60);
}

}  // namespace
}  // namespace fencepost::host
