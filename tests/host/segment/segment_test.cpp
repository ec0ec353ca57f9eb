// Whole images through segmentation: the log has exactly the painted blobs.
#include "host/segment/segment.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/host/segment/pictures.hpp"

namespace fencepost::host {
namespace {

/// Two images of a room with a block, so that colours are in more than one.
std::vector<cv::Mat> twice(const cv::Mat& image) { return {image, image}; }

struct Segment : testing::Test {
  cv::Mat image = room();
};

TEST_F(Segment, FindsPaintedBlocksWithTheirExactBoxes) {
  paint(image, 20, 40, 49, 79, kRed);
  paint(image, 90, 50, 109, 69, kBlue);
  SegmentSummary summary;
  const Recorded log = segmented(twice(image), {}, &summary);
  ASSERT_EQ(log.frames.size(), 2U);
  ASSERT_EQ(log.frames[1].blobs.size(), 2U);
  expect_box(log.frames[1].blobs[0], 20, 40, 49, 79);
  expect_box(log.frames[1].blobs[1], 90, 50, 109, 69);
  EXPECT_EQ(log.frames[1].blobs[0].pixels, 30U * 40U);
  EXPECT_EQ(log.frames[1].blobs[0].rgb, kRed);
  EXPECT_EQ(blobs_named(log, "red").size(), 1U);
  EXPECT_EQ(blobs_named(log, "blue").size(), 1U);
  EXPECT_EQ(log.signatures.size(), 2U);
  EXPECT_EQ(summary.blobs, 4U);
  EXPECT_EQ(summary.signatures[0].images, 2U);
}

TEST_F(Segment, ABlocksLitAndShadedSidesAreOne) {
  paint(image, 20, 40, 39, 79, kRed);
  paint(image, 40, 40, 49, 79, kShadedRed);
  for (const std::vector<record::Signature>& signatures :
       {std::vector<record::Signature>{}, std::vector<record::Signature>{given(7, "red", {220, 20, 20})}}) {
    SegmentOptions options;
    options.classes.signatures = signatures;
    const Recorded log = segmented(twice(image), options);
    ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
    expect_box(log.frames[0].blobs[0], 20, 40, 49, 79);
    EXPECT_EQ(log.signatures[0].signature, signatures.empty() ? 1 : 7);
  }
}

// A round thing shows all shades from light to dark.
TEST_F(Segment, ACansShadesAreOneSignature) {
  for (int u = 40; u <= 79; ++u) {
    const double light = 0.25 + 0.75 * (79 - u) / 39.0;
    const auto lit = [&](int channel) { return static_cast<std::uint8_t>(light * channel); };
    paint(image, u, 40, u, 79, {lit(60), lit(190), lit(90)});
  }
  const Recorded log = segmented(twice(image));
  ASSERT_EQ(log.signatures.size(), 1U);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 40, 40, 79, 79);
}

TEST_F(Segment, RedOnBothSidesOfTheHueSeamIsOne) {
  paint(image, 20, 40, 39, 79, {200, 30, 41});  // hue 356
  paint(image, 40, 40, 59, 79, {200, 41, 30});  // hue 4
  const Recorded log = segmented(twice(image));
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 20, 40, 59, 79);
}

TEST_F(Segment, AShadowOnTheFloorIsNoObject) {
  paint(image, 20, 40, 49, 79, kRed);
  paint(image, 50, 70, 89, 85, {100, 92, 82});   // the wood in half the light
  paint(image, 100, 20, 130, 50, {95, 94, 90});  // and the wall
  const Recorded log = segmented(twice(image));
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U) << log.text;
  expect_box(log.frames[0].blobs[0], 20, 40, 49, 79);
}

TEST_F(Segment, GreyThingsAreFoundBeforeColouredWallsAndMayBeGivenBeforeGreyOnes) {
  cv::Mat coloured = canvas(160, 120, {90, 140, 190});
  paint(coloured, 60, 40, 99, 89, kGrey);
  ASSERT_EQ(blobs_named(segmented(twice(coloured)), "grey").size(), 1U);
  cv::Mat white = canvas(160, 120, {235, 235, 235});
  paint(white, 60, 40, 99, 89, {60, 60, 60});
  SegmentOptions options;
  options.classes.signatures = {given(3, "box", {64, 64, 64})};
  const Recorded log = segmented(twice(white), options);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 60, 40, 99, 89);
}

TEST_F(Segment, TheBackgroundMayBeGiven) {
  // Red takes most of the image: found, it would be the background.
  image = canvas(160, 120, kRed);
  paint(image, 60, 40, 99, 89, kBlue);
  EXPECT_EQ(blobs_named(segmented(twice(image)), "red").size(), 0U);
  SegmentOptions options;
  options.classes.background.colours = {kBlue};
  const Recorded log = segmented(twice(image), options);
  ASSERT_EQ(blobs_named(log, "red").size(), 1U);
  EXPECT_EQ(blobs_named(log, "blue").size(), 0U);
  expect_box(blobs_named(log, "red")[0], 0, 0, 159, 119);
}

TEST_F(Segment, ASilhouetteIsAllThatIsNotBlack) {
  image = canvas(160, 120, {12, 10, 10});
  paint(image, 40, 30, 69, 89, {180, 175, 170});
  paint(image, 70, 30, 79, 89, {64, 62, 60});
  paint(image, 80, 50, 99, 69, kRed);
  SegmentOptions options;
  options.classes.silhouette = true;
  options.classes.background.darkest = 48;
  const Recorded log = segmented({image}, options);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 40, 30, 99, 89);
  EXPECT_EQ(log.signatures.at(0).name.view(), "silhouette");
}

TEST_F(Segment, AThingThatTheImageCutsEndsOnItsBorder) {
  paint(image, 0, 40, 29, 79, kRed);
  paint(image, 130, 40, 159, 79, kBlue);
  const Recorded log = segmented(twice(image));
  expect_box(blobs_named(log, "red").at(0), 0, 40, 29, 79);
  expect_box(blobs_named(log, "blue").at(0), 130, 40, 159, 79);
}

TEST_F(Segment, APostOfTheWallsColourCutsInTwoUnlessThin) {
  paint(image, 20, 40, 79, 79, kRed);
  paint(image, 40, 30, 59, 85, kWall);
  EXPECT_EQ(segmented(twice(image)).frames.at(0).blobs.size(), 2U);
  cv::Mat thin = room();
  paint(thin, 20, 40, 79, 79, kRed);
  paint(thin, 48, 30, 53, 85, kWall);
  SegmentOptions options;
  options.max_gap = 6;
  SegmentSummary summary;
  const Recorded log = segmented(twice(thin), options, &summary);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 1U);
  expect_box(log.frames[0].blobs[0], 20, 40, 79, 79);
  EXPECT_EQ(summary.merged, 2U);
}

TEST_F(Segment, NoiseIsSmoothedAway) {
  std::mt19937 random(3);
  std::vector<cv::Mat> images;
  for (int i = 0; i < 2; ++i) {
    image = room();
    paint(image, 20, 40, 49, 79, kRed);
    paint(image, 90, 50, 109, 69, kBlue);
    for (int v = 0; v < image.rows; ++v) {
      for (int u = 0; u < image.cols; ++u) {
        for (int c = 0; c < 3; ++c) {
          const int noisy = image.at<cv::Vec3b>(v, u)[c] + static_cast<int>(random() % 17) - 8;
          image.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<std::uint8_t>(noisy);
        }
      }
    }
    images.push_back(image);
  }
  const Recorded log = segmented(images);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 2U);
  const sensor::Blob red = blobs_named(log, "red").at(0);
  EXPECT_NEAR(red.x1, 20, 1);
  EXPECT_NEAR(red.x2, 49, 1);
}

TEST_F(Segment, AFrameHoldsTheSixteenLargest) {
  image = room(320, 240);
  for (int i = 0; i < 18; ++i) {  // a pixel wider each
    const int x = 8 + 50 * (i % 6);
    const int y = 20 + 60 * (i / 6);
    paint(image, x, y, x + 15 + i, y + 29, kRed);
  }
  SegmentSummary summary;
  const Recorded log = segmented(twice(image), {}, &summary);
  ASSERT_EQ(log.frames.at(0).blobs.size(), 16U);
  EXPECT_EQ(summary.dropped, 4U) << "two in each image";
  EXPECT_EQ(log.frames[0].blobs[0].pixels, 33U * 30U);
  EXPECT_EQ(log.frames[0].blobs[15].pixels, 18U * 30U);
}

TEST_F(Segment, GivenColoursThatAreNowhereAreKeptAndCountedNowhere) {
  paint(image, 20, 40, 49, 79, kRed);
  SegmentOptions options;
  options.classes.signatures = {given(1, "red", kRed), given(2, "green", kGreen)};
  SegmentSummary summary;
  const Recorded log = segmented(twice(image), options, &summary);
  ASSERT_EQ(log.signatures.size(), 2U);
  ASSERT_EQ(summary.signatures.size(), 2U);
  EXPECT_EQ(summary.signatures[0].images, 2U);
  EXPECT_EQ(summary.signatures[1].images, 0U);
}

TEST_F(Segment, TheLogHasAPoseAtEachExposureAndNoGap) {
  paint(image, 20, 40, 49, 79, kRed);
  Pictures pictures;
  pictures.add(image);
  pictures.add(image);
  std::vector<View> views = pictures.views();
  views[0].pose = {10, 1, 2, 3.1};
  views[1].pose = {12, 2, 2, -3.1};  // 0.083 rad on, through pi
  sensor::CameraIntrinsics camera = camera_of(160, 120);
  camera.latency = base::milliseconds(50);
  const SegmentResult result = segment(views, camera, {});
  ASSERT_TRUE(result.ok());
  const Recorded log = read_back(result->log);
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_DOUBLE_EQ(log.frames[0].t.to_double(), 10.05);
  ASSERT_EQ(log.odometry.size(), 6U) << "2 s in steps of at most 0.4 s";
  EXPECT_EQ(log.odometry.front().t.to_double(), 10);
  EXPECT_EQ(log.odometry.back().t.to_double(), 12);
  EXPECT_NEAR(log.odometry[1].x.to_double(), 1.2, 1e-9);
  EXPECT_NEAR(log.odometry[1].heading.to_double(), 3.1 + (2 * M_PI - 6.2) / 5, 1e-4);
  EXPECT_EQ(log.headers.at(0).target.view(), "segment");
}

TEST_F(Segment, SameImagesSameBytes) {
  paint(image, 20, 40, 49, 79, kRed);
  paint(image, 90, 50, 109, 69, kBlue);
  EXPECT_EQ(segmented(twice(image)).text, segmented(twice(image)).text);
}

TEST_F(Segment, PicturesShowWhatWasFound) {
  paint(image, 20, 40, 49, 79, kRed);
  Pictures pictures;
  pictures.add(image);
  SegmentOptions options;
  options.classes.signatures = {given(1, "red", {255, 0, 0})};
  std::vector<cv::Mat> shown;
  SegmentHooks hooks;
  std::vector<std::size_t> steps;
  hooks.labelled = [&](std::size_t, const cv::Mat& picture) { shown.push_back(picture); };
  hooks.progress = [&](std::size_t done, std::size_t all) {
    steps.push_back(done);
    EXPECT_EQ(all, 2U);
  };
  ASSERT_TRUE(segment(pictures.views(), camera_of(160, 120), options, hooks).ok());
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown[0].at<cv::Vec3b>(70, 40), cv::Vec3b(0, 0, 255));
  EXPECT_EQ(shown[0].at<cv::Vec3b>(79, 30), cv::Vec3b(255, 255, 255)) << "the box";
  EXPECT_LT(shown[0].at<cv::Vec3b>(10, 10)[0], 100) << "the rest is dim";
  EXPECT_EQ(steps, (std::vector<std::size_t>{0, 1, 2}));
}

std::string complaint(const std::vector<View>& views, const sensor::CameraIntrinsics& camera) {
  const SegmentResult result = segment(views, camera, {});
  return result.ok() ? "none" : result.error().message();
}

TEST_F(Segment, SaysWhichImageHasAnotherSize) {
  paint(image, 20, 40, 49, 79, kRed);
  Pictures pictures;
  pictures.add(image);
  pictures.add(room(80, 60));
  EXPECT_NE(complaint(pictures.views(), camera_of(160, 120))
                .find("view1.png: is 80 x 60 px, the calibration is for 160 x 120"),
            std::string::npos);
}

TEST_F(Segment, SaysWhenThereIsNothing) {
  Pictures pictures;
  pictures.add(canvas(160, 120, kWall));
  pictures.add(canvas(160, 120, kWall));
  EXPECT_NE(complaint(pictures.views(), camera_of(160, 120)).find("nothing but background"), std::string::npos);
  EXPECT_NE(complaint({}, camera_of(160, 120)).find("are none"), std::string::npos);
  EXPECT_NE(complaint({{"/nowhere.png", {}}}, camera_of(160, 120)).find("/nowhere.png: cannot be read"),
            std::string::npos);
}

}  // namespace
}  // namespace fencepost::host
