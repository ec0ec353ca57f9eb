#include "host/paper/tour.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/host/paper/worlds.hpp"

namespace fencepost::host {
namespace {

using testing::two_squares;

TEST(Drive, KeepsFramesPosesAndImagesInStep) {
  const Tour tour = drive(two_squares());
  ASSERT_EQ(tour.frames.size(), 3U);
  ASSERT_EQ(tour.poses.size(), 3U);
  ASSERT_EQ(tour.images.size(), 3U);
  EXPECT_NEAR(believed_pose(tour, 1).heading, 0.15, 1e-4);
  EXPECT_EQ(tour.images[0].regions.size(), tour.frames[0].blobs.size());
  EXPECT_NE(tour.log.find("$FPHDR"), std::string::npos);
}

TEST(Drive, ColoursAreOffByTheNoiseOnly) {
  const Tour tour = drive(two_squares());
  const Tour again = drive(two_squares());
  for (std::size_t i = 0; i < tour.images[0].regions.size(); ++i) {
    const Region& region = tour.images[0].regions[i];
    ASSERT_TRUE(region.colour.has_value());
    EXPECT_NEAR(region.colour->red, region.signature == 1 ? 200 : 210, 60);  // 5 sigma
    EXPECT_NE(region.colour->red, std::round(region.colour->red));
    EXPECT_EQ(region.colour->red, again.images[0].regions[i].colour->red);
  }
}

TEST(Drive, KnowsWhichEndsAreHiddenWhateverTheNoiseDoes) {
  // Turned by 0.4 rad, yellow (bearings -0.2 to -0.1) is 0.5 to 0.6 rad to the right: beside the border at 0.464.
  Scene scene = two_squares();
  scene.objects.push_back({"post", 1, 0, 0.3, {{{0.5, 0.07}, {0.52, 0.07}, {0.52, 0.2}, {0.5, 0.2}}, {}}});
  scene.signatures.push_back({3, "blue", {0, 0, 255}});
  scene.objects.back().signature = 3;
  scene.noise.loss_probability = 1;
  const Tour tour = drive(scene);
  // The post covers y = 0.14 and more at 1 m: red's left end.
  EXPECT_TRUE(tour.hidden[0][0].left);
  EXPECT_FALSE(tour.hidden[0][0].right);
  EXPECT_FALSE(tour.hidden[0][1].left);
  EXPECT_FALSE(tour.hidden[0][1].right);
}

TEST(IsWholeIn, WantsBothEndsAndSomeWidth) {
  RealImage image;
  image.regions = {{10, 10, 40, 40, 0, 1, std::nullopt}};
  image.truths = {{0, {}, BlobEnd::kEdge, BlobEnd::kLost, 1}};
  EXPECT_TRUE(is_whole_in(image, 0));
  EXPECT_FALSE(is_whole_in(image, 1));
  image.truths[0].right = BlobEnd::kBorder;
  EXPECT_FALSE(is_whole_in(image, 0));
  image.truths[0].right = BlobEnd::kOccluded;
  EXPECT_FALSE(is_whole_in(image, 0));
  image.truths[0].right = BlobEnd::kEdge;
  image.regions[0].right = 21;  // 11 px
  EXPECT_FALSE(is_whole_in(image, 0));
  image.regions[0].right = 22;
  EXPECT_TRUE(is_whole_in(image, 0));
  image.truths[0].others = {3};  // grown together with another one
  EXPECT_FALSE(is_whole_in(image, 0));
  EXPECT_TRUE(is_of(image.truths[0], 0));
  EXPECT_TRUE(is_of(image.truths[0], 3));
  EXPECT_FALSE(is_of(image.truths[0], 2));
}

TEST(Drive, RefusesASceneWithoutPath) {
  Scene scene = two_squares();
  scene.path = std::monostate{};
  EXPECT_THROW(drive(scene), std::runtime_error);
}

}  // namespace
}  // namespace fencepost::host
