#include <gtest/gtest.h>

#include "host/segment/image_file.hpp"
#include "host/segment/setup_file.hpp"

namespace fencepost::host {
namespace {

/// As OpenCV's calibration sample writes it.
std::string opencv(const std::string& distortion) {
  return "%YAML:1.0\n---\ncalibration_time: \"Sat Jan 1 12:00:00 2022\"\nimage_width: 640\nimage_height: 480\n"
         "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
         "   data: [ 6.5746697810243404e+02, 0., 3.1950000000000000e+02, 0.,\n       6.5746697810243404e+02, "
         "2.395e+02, 0., 0., 1. ]\n"
         "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n   data: [ " +
         distortion + " ]\navg_reprojection_error: 2.0e-01\n";
}

TEST(OpenCvCamera, IsReadWithItsFirstCoefficient) {
  const sensor::CameraIntrinsics camera = parse_camera(opencv("-4.1802327e-02, 0., 0., 0., 0."), "out_camera_data.yml");
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx.raw, 65'747);
  EXPECT_EQ(camera.cx.raw, 31'950);
  EXPECT_EQ(camera.cy.raw, 23'950);
  EXPECT_EQ(camera.k1.raw, -418);
  EXPECT_FALSE(camera.mount.pitch);
}

TEST(OpenCvCamera, IsReadAsRosWritesIt) {
  const sensor::CameraIntrinsics camera = parse_camera(
      "image_width: 320\nimage_height: 240\ncamera_name: narrow\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
      "  data: [270.5, 0, 160, 0, 271.5, 120, 0, 0, 1]\ndistortion_model: plumb_bob\ndistortion_coefficients:\n"
      "  rows: 1\n  cols: 5\n  data: [0.01, 0, 0, 0, 0]\n",
      "ost.yaml");
  EXPECT_EQ(camera.fx.raw, 27'050);
  EXPECT_EQ(camera.fy.raw, 27'150);
  EXPECT_EQ(camera.k1.raw, 100);
}

TEST(OpenCvCamera, IsReadWithANumberALine) {
  const sensor::CameraIntrinsics camera = parse_camera(
      "camera_matrix:\r\n  data:\r\n  - 270.5\r\n  - 0\r\n  - 160\r\n  - 0\r\n  - 271.5\r\n  - 120\r\n  - 0\r\n  - "
      "0\r\n  - 1\r\n"
      "distortion_coefficients:\n  rows: 1\n  data:\n  - -0.01\n  - 0\nimage_height: 240\nimage_width: 320",
      "ost.yaml");
  EXPECT_EQ(camera.fy.raw, 27'150);
  EXPECT_EQ(camera.cx.raw, 16'000);
  EXPECT_EQ(camera.k1.raw, -100);
  EXPECT_EQ(camera.width, 320);
}

TEST(OpenCvCamera, IsRefusedWhereANumberIsNone) {
  for (const char* wrong : {"nan", ".inf", "x", "[", "1e999"}) {
    EXPECT_THROW(static_cast<void>(parse_camera(opencv(std::string("0., 0., 0., 0., ") + wrong), "c.yml")),
                 SegmentProblem)
        << wrong;
  }
}

TEST(OpenCvCamera, IsRefusedWhereOneCoefficientIsNotEnoughOrAKeyIsMissing) {
  try {
    static_cast<void>(parse_camera(opencv("-0.04, 0.5, 0., 0., 0."), "c.yml"));
    FAIL();
  } catch (const SegmentProblem& problem) {
    EXPECT_EQ(problem.where, "c.yml");
    EXPECT_NE(problem.what.find("beyond k1"), std::string::npos);
  }
  std::string without = opencv("0., 0., 0., 0., 0.");
  without.erase(without.find("image_width"), 17);
  EXPECT_THROW(static_cast<void>(parse_camera(without, "c.yml")), SegmentProblem);
  EXPECT_THROW(static_cast<void>(parse_camera("%YAML:1.0\n---\ncamera_matrix: [", "c.yml")), SegmentProblem);
}

}  // namespace
}  // namespace fencepost::host
