#include "host/evaluate/frame_truths.hpp"

#include <gtest/gtest.h>

#include "host/scene/load.hpp"

namespace fencepost::host {
namespace {

Scene blocks() {
  const LoadedScene scene = load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/blocks_arc.json");
  EXPECT_TRUE(scene.ok());
  return *scene;
}

std::vector<FrameTruth> frames_of(const Scene& scene) {
  std::vector<FrameTruth> frames;
  const auto summary = simulate_with_truth(
      scene, [](std::string_view) {}, [&](const FrameTruth& truth) { frames.push_back(truth); });
  EXPECT_TRUE(summary.ok());
  return frames;
}

// In this scene signature 1, 2, 3 are objects 0, 1, 2, so the blob's signature gives the owner.
TEST(FrameTruths, KnowsTheOwnerOfEachBlobOfItsOwnRun) {
  const FrameTruths truths(blocks());
  std::size_t compared = 0;
  for (const FrameTruth& truth : frames_of(blocks())) {
    const recon::WaitingFrame frame = recon::make_waiting(truth.frame, 0);
    const auto owners = truths.owners(frame);
    ASSERT_TRUE(owners.has_value());
    ASSERT_EQ(owners->size(), frame.blobs.size());
    for (std::size_t b = 0; b < owners->size(); ++b) {
      EXPECT_EQ((*owners)[b], frame.blobs[b].signature - std::size_t{1});
      ++compared;
    }
  }
  EXPECT_GT(compared, 200U);
}

TEST(FrameTruths, SaysNothingOfAnotherFrame) {
  const FrameTruths truths(blocks());
  const FrameTruth truth = frames_of(blocks()).at(10);
  const recon::WaitingFrame frame = recon::make_waiting(truth.frame, 0);
  ASSERT_TRUE(truths.owners(frame).has_value());
  recon::WaitingFrame other = frame;
  other.frame = 4000;
  EXPECT_FALSE(truths.owners(other).has_value());
  other = frame;
  other.t.raw += 1;
  EXPECT_FALSE(truths.owners(other).has_value());
  other = frame;
  other.blobs[0].box.x1 = static_cast<std::int16_t>(other.blobs[0].box.x1 + 1);
  EXPECT_FALSE(truths.owners(other).has_value());
  other = frame;
  other.blobs[0].signature = 9;
  EXPECT_FALSE(truths.owners(other).has_value());
  other = frame;
  other.blobs.erase_at(0);
  EXPECT_FALSE(truths.owners(other).has_value());
}

TEST(FrameTruths, WithoutAPathKnowsNothing) {
  Scene scene = blocks();
  const recon::WaitingFrame frame = recon::make_waiting(frames_of(scene).at(0).frame, 0);
  scene.path = std::monostate{};
  EXPECT_FALSE(FrameTruths(scene).owners(frame).has_value());
}

// A post in front of a can splits it in two. The robot may join the pieces, and the box belongs to the wider piece's
// object, although the post's blob lies inside it.
TEST(FrameTruths, AJoinedBlobBelongsToItsWidestPart) {
  Scene scene = blocks();
  scene.objects = {{"post", 2, 0, 0.2, {{{-0.35, -0.01}, {-0.33, -0.01}, {-0.33, 0.01}, {-0.35, 0.01}}, {}}},
                   {"can", 1, 0, 0.2, {{{-0.2, -0.12}, {0.1, -0.12}, {0.1, 0.1}, {-0.2, 0.1}}, {}}}};
  PosesPath path;
  path.poses = {{0, -1.2, 0, 0}};
  scene.path = path;
  const FrameTruth truth = frames_of(scene).at(0);
  ASSERT_EQ(truth.frame.blobs.size(), 3U) << "post, and the can left and right of it";
  recon::WaitingFrame frame = recon::make_waiting(truth.frame, 0);
  const auto apart = FrameTruths(scene).owners(frame);
  ASSERT_TRUE(apart.has_value());
  EXPECT_EQ(*apart, (BlobOwners{1, 1, 0}));

  frame.blobs[0].box.x2 = frame.blobs[1].box.x2;
  frame.blobs.erase_at(1);
  const auto joined = FrameTruths(scene).owners(frame);
  ASSERT_TRUE(joined.has_value());
  EXPECT_EQ(*joined, (BlobOwners{1, 0}));
}

// Two cans of one colour side by side in the image: their blob shows both and counts for neither.
TEST(FrameTruths, ABlobOfTwoObjectsIsNobodys) {
  Scene scene = blocks();
  scene.objects = {{"near", 1, 0, 0.2, {{{-0.4, -0.1}, {-0.3, -0.1}, {-0.3, 0.0}, {-0.4, 0.0}}, {}}},
                   {"far", 1, 0, 0.2, {{{-0.2, -0.02}, {0.1, -0.02}, {0.1, 0.1}, {-0.2, 0.1}}, {}}}};
  PosesPath path;
  path.poses = {{0, -1.2, 0, 0}};
  scene.path = path;
  const FrameTruth truth = frames_of(scene).at(0);
  ASSERT_EQ(truth.blobs.size(), 1U);
  EXPECT_EQ(truth.blobs[0].others.size(), 1U);
  const auto owners = FrameTruths(scene).owners(recon::make_waiting(truth.frame, 0));
  ASSERT_TRUE(owners.has_value());
  EXPECT_EQ(*owners, (BlobOwners{std::nullopt}));
}

}  // namespace
}  // namespace fencepost::host
