#include "host/emulate/scene/image_fit.hpp"

#include <gtest/gtest.h>

#include "tests/host/emulate/scene/rig.hpp"

namespace fencepost::emulate {
namespace {

sensor::CameraIntrinsics camera(std::uint16_t width, std::uint16_t height) {
  sensor::CameraIntrinsics intrinsics;
  intrinsics.width = width;
  intrinsics.height = height;
  intrinsics.fx = intrinsics.fy = {40'000};
  intrinsics.cx = {static_cast<std::int32_t>(50 * (width - 1))};
  intrinsics.cy = {static_cast<std::int32_t>(50 * (height - 1))};
  return intrinsics;
}

sensor::BlobFrame frame_of(std::initializer_list<sensor::Blob> blobs) {
  sensor::BlobFrame frame;
  for (const sensor::Blob& blob : blobs) (void)frame.blobs.push_back(blob);
  return frame;
}

TEST(ImageFit, LeavesBoxesOfItsOwnSizeAlone) {
  ImageFit fit(camera(316, 208), {316, 208});
  EXPECT_FALSE(fit.scales());
  const sensor::BlobFrame fitted = fit.fit(frame_of({box(1, 0, 0, 315, 207), box(2, 17, 30, 17, 99)}));
  ASSERT_EQ(fitted.blobs.size(), 2U);
  EXPECT_EQ(fitted.blobs[1].x1, 17);
  EXPECT_EQ(fitted.blobs[1].x2, 17);
  EXPECT_EQ(fitted.blobs[1].y2, 99);
  EXPECT_EQ(fitted.blobs[1].cx.raw, 170);
  EXPECT_EQ(fitted.blobs[1].pixels, 70U) << "not given: the box's";
}

// 640 x 480 to 160 x 120: edges 100 and 141 become 25 and 35.25, so the columns are 25 to 34. Edges 4 and 5 become 1
// and 1.25, which is less than a pixel.
TEST(ImageFit, ScalesEdges) {
  ImageFit fit(camera(640, 480), {160, 120});
  EXPECT_TRUE(fit.scales());
  const sensor::BlobFrame fitted = fit.fit(frame_of({box(1, 100, 0, 140, 479), box(1, 4, 4, 4, 4)}));
  EXPECT_EQ(fitted.blobs[0].x1, 25);
  EXPECT_EQ(fitted.blobs[0].x2, 34);
  EXPECT_EQ(fitted.blobs[0].y1, 0);
  EXPECT_EQ(fitted.blobs[0].y2, 119);
  EXPECT_EQ(fitted.blobs[1].x1, 1);
  EXPECT_EQ(fitted.blobs[1].x2, 1) << "a pixel at least";
}

// cx 319.5 is the edge coordinate 320, a quarter of it 80, less a half: 79.5.
TEST(ImageFit, TellsTheCalibrationThatBelongsToIt) {
  const sensor::CameraIntrinsics fitted = fitted_calibration(camera(640, 480), {160, 120}, "cmucam4");
  EXPECT_EQ(fitted.model.view(), "cmucam4");
  EXPECT_EQ(fitted.width, 160);
  EXPECT_EQ(fitted.fx.raw, 10'000);
  EXPECT_EQ(fitted.cx.raw, 7'950);
  EXPECT_EQ(fitted.cy.raw, 5'950);
}

TEST(ImageFit, CountsWhatTheDeviceCannotTell) {
  ImageFit fit(camera(100, 100), {100, 100, 2, 1, 1, 3, 50});
  const sensor::BlobFrame fitted =
      fit.fit(frame_of({box(0, 0, 0, 9, 9), box(4, 0, 0, 9, 9), box(1, 0, 0, 9, 9), box(1, 20, 0, 29, 9),
                        box(2, 0, 0, 100, 9), box(2, 0, 0, 9, 9), box(3, 0, 0, 9, 9)}));
  EXPECT_EQ(fitted.blobs.size(), 2U);
  EXPECT_EQ(fit.losses().signatures, 2U);
  EXPECT_EQ(fit.losses().outside, 1U);
  EXPECT_EQ(fit.losses().blobs, 2U) << "a second one of 1, and a third at all";
}

}  // namespace
}  // namespace fencepost::emulate
