#include "drivers/cmucam/measure.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace fencepost::cmucam {
namespace {

using base::Error;

Packet packet(char letter, std::initializer_list<std::uint8_t> fields) {
  Packet packet;
  packet.letter = letter;
  for (const std::uint8_t field : fields) packet.fields.at(packet.count++) = field;
  return packet;
}

// x 40..50, y 60..80, 1-based with inclusive ends: ours are one less. 20 eighths are 160 pixels.
TEST(CmuCamBlob, OneBasedPixelsBecomeZeroBased) {
  const auto blob = to_blob(packet('M', {45, 71, 40, 60, 50, 80, 20, 128}), kCmuCam1, 3);
  EXPECT_EQ(blob.value(), (sensor::Blob{3, 39, 59, 49, 79, {440}, {700}, 160, {}}));
}

TEST(CmuCamBlob, ZeroBasedPixelsStay) {
  const auto blob = to_blob(packet('T', {24, 49, 20, 40, 29, 59, 150, 255}), kCmuCam3, 1);
  EXPECT_EQ(blob.value(), (sensor::Blob{1, 20, 40, 29, 59, {240}, {490}, 150, {}}));
}

TEST(CmuCamBlob, ACmuCam2DoesNotTellItsArea) {
  const auto blob = to_blob(packet('T', {45, 71, 40, 60, 50, 80, 20, 181}), kCmuCam2, 1);
  EXPECT_EQ(blob.value(), (sensor::Blob{1, 39, 59, 49, 79, {440}, {700}, 0, {}}));
}

// All of 20 x 30 pixels match: 600, though its own field says 7/255 of 19200 = 527.
TEST(CmuCamBlob, ACmuCam4TellsItsAreaByConfidence) {
  const auto blob = to_blob(packet('T', {80, 60, 70, 45, 89, 74, 7, 255}), kCmuCam4, 1);
  EXPECT_EQ(blob.value(), (sensor::Blob{1, 70, 45, 89, 74, {800}, {600}, 600, {}}));
}

TEST(CmuCamBlob, WithoutACentroidTheMiddleOfTheBox) {
  const auto blob = to_blob(packet('C', {40, 60, 51, 80, 20, 128}), kCmuCam1, 1);
  EXPECT_EQ(blob.value(), (sensor::Blob{1, 39, 59, 50, 79, {445}, {690}, 160, {}}));
}

TEST(CmuCamBlob, TheServosPositionIsSkipped) {
  const auto blob = to_blob(packet('N', {128, 45, 71, 40, 60, 50, 80, 20, 128}), kCmuCam1, 1);
  EXPECT_EQ(blob.value().x1, 39);
  EXPECT_EQ(to_blob(packet('N', {128, 0, 0, 0, 0, 0, 0, 0, 0}), kCmuCam1, 1).error(), Error::kNotReady);
}

TEST(CmuCamBlob, NothingFound) {
  EXPECT_EQ(to_blob(packet('M', {0, 0, 0, 0, 0, 0, 0, 0}), kCmuCam1, 1).error(), Error::kNotReady);
  EXPECT_EQ(to_blob(packet('C', {0, 0, 0, 0, 0, 0}), kCmuCam1, 1).error(), Error::kNotReady);
  EXPECT_EQ(to_blob(packet('T', {0, 0, 0, 0, 0, 0, 0, 0}), kCmuCam3, 1).error(), Error::kNotReady);
}

TEST(CmuCamBlob, TooFewPixelsForItsBoxAreNoise) {
  EXPECT_EQ(to_blob(packet('M', {45, 71, 40, 60, 50, 80, 1, 7}), kCmuCam1, 1).error(), Error::kNotReady);
  EXPECT_TRUE(to_blob(packet('M', {45, 71, 40, 60, 50, 80, 1, 8}), kCmuCam1, 1).ok());
  EXPECT_EQ(to_blob(packet('T', {45, 71, 40, 60, 50, 80, 1, 1}), kCmuCam2, 1).error(), Error::kNotReady);
  EXPECT_TRUE(to_blob(packet('T', {45, 71, 40, 60, 50, 80, 1, 2}), kCmuCam2, 1).ok());
}

TEST(CmuCamBlob, ASaturatedCountIsNoCount) {
  EXPECT_EQ(to_blob(packet('T', {24, 49, 20, 40, 29, 59, 253, 255}), kCmuCam3, 1)->pixels, 253U);
  EXPECT_EQ(to_blob(packet('T', {24, 49, 20, 40, 29, 59, 254, 255}), kCmuCam3, 1)->pixels, 0U) << "255 in raw";
  EXPECT_EQ(to_blob(packet('M', {45, 71, 40, 60, 50, 80, 255, 128}), kCmuCam1, 1)->pixels, 0U);
}

TEST(CmuCamBlob, RefusesWhatCannotBeABox) {
  const auto refused = [](std::initializer_list<std::uint8_t> fields, const Dialect& dialect) {
    const auto blob = to_blob(packet('T', fields), dialect, 1);
    return !blob && blob.error() == Error::kBadInput;
  };
  EXPECT_TRUE(refused({45, 71, 50, 60, 40, 80, 20, 128}, kCmuCam1)) << "x swapped";
  EXPECT_TRUE(refused({45, 71, 40, 80, 50, 60, 20, 128}, kCmuCam1)) << "y swapped";
  EXPECT_TRUE(refused({39, 71, 40, 60, 50, 80, 20, 128}, kCmuCam1)) << "centroid left of the box";
  EXPECT_TRUE(refused({45, 81, 40, 60, 50, 80, 20, 128}, kCmuCam1)) << "centroid below the box";
  EXPECT_TRUE(refused({45, 71, 0, 60, 50, 80, 20, 128}, kCmuCam1)) << "no column 0";
  EXPECT_TRUE(refused({45, 71, 40, 60, 81, 80, 20, 128}, kCmuCam1)) << "80 columns";
  EXPECT_TRUE(refused({45, 71, 40, 60, 50, 144, 20, 128}, kCmuCam1)) << "143 rows";
  EXPECT_TRUE(to_blob(packet('M', {45, 71, 1, 1, 80, 143, 20, 128}), kCmuCam1, 1).ok()) << "the whole image";
  EXPECT_TRUE(to_blob(packet('T', {45, 71, 0, 0, 87, 143, 20, 128}), kCmuCam3, 1).ok());
  EXPECT_TRUE(refused({45, 71, 0, 0, 88, 143, 20, 128}, kCmuCam3));
  EXPECT_EQ(to_blob(packet('S', {90, 40, 41, 3, 4, 5}), kCmuCam1, 1).error(), Error::kBadInput);
}

TEST(CmuCamBlob, ACentroidAtTheEdgeOfItsBoxIsInside) {
  const auto taken = [](std::uint8_t mx, std::uint8_t my) {
    return to_blob(packet('M', {mx, my, 40, 60, 50, 80, 20, 128}), kCmuCam1, 1).ok();
  };
  EXPECT_TRUE(taken(40, 60));
  EXPECT_TRUE(taken(50, 80));
  EXPECT_FALSE(taken(39, 70));
  EXPECT_FALSE(taken(51, 70));
  EXPECT_FALSE(taken(45, 59));
  EXPECT_FALSE(taken(45, 81));
  EXPECT_TRUE(to_blob(packet('M', {40, 60, 40, 60, 40, 60, 1, 255}), kCmuCam1, 1).ok()) << "one pixel";
}

// 88 columns of 44.1 deg: 44 / tan 22.05 deg = 108.63; rows are taller in number by the pixels' shape.
TEST(CmuCamDialect, NominalCalibration) {
  sensor::CameraMount mount;
  mount.z = {1'200};
  const sensor::CameraIntrinsics camera = nominal_intrinsics(kCmuCam3, mount);
  EXPECT_EQ(camera.model.view(), "cmucam3");
  EXPECT_EQ(camera.width, 88);
  EXPECT_EQ(camera.height, 144);
  EXPECT_NEAR(camera.fx.raw, 10'863, 2);
  EXPECT_NEAR(camera.fy.raw, 23'772, 3);
  EXPECT_EQ(camera.cx.raw, 4'350);
  EXPECT_EQ(camera.cy.raw, 7'150);
  EXPECT_EQ(camera.mount, mount);
  EXPECT_EQ(nominal_intrinsics(kCmuCam3High, mount).cy.raw, 14'350) << "the lens looks at row 143.5 of 288";
  EXPECT_EQ(nominal_intrinsics(kCmuCam3High, mount).height, 255);
}

}  // namespace
}  // namespace fencepost::cmucam
