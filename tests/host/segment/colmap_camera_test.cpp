// Calibrations as COLMAP writes them.
#include "host/segment/colmap_camera.hpp"

#include <gtest/gtest.h>

#include "host/segment/image_file.hpp"
#include "host/segment/setup_file.hpp"

namespace fencepost::host {
namespace {

const std::string kHead =
    "# Camera list with one line of data per camera:\n"
    "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
    "# Number of cameras: 1\n";

TEST(ColmapCamera, CountsPixelsFromTheCorner) {
  const sensor::CameraIntrinsics camera =
      parse_camera(kHead + "1 PINHOLE 640 480 500.25 501.5 320 240\n", "cameras.txt");
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_NEAR(camera.fx.to_double(), 500.25, 0.01);
  EXPECT_NEAR(camera.fy.to_double(), 501.5, 0.01);
  EXPECT_NEAR(camera.cx.to_double(), 319.5, 0.01) << "the middle of an image is between its two middle pixels";
  EXPECT_NEAR(camera.cy.to_double(), 239.5, 0.01);
  EXPECT_EQ(camera.k1.raw, 0);
  EXPECT_FALSE(camera.mount.pitch.has_value());
}

TEST(ColmapCamera, KnowsTheModelsThatAPinholeWithOneCoefficientIs) {
  const auto of = [](const std::string& line) { return parse_colmap_calibration(kHead + line + "\n", "c"); };
  EXPECT_NEAR(of("1 SIMPLE_PINHOLE 640 480 500 320 240").fy.to_double(), 500, 0.01);
  const auto radial = of("2 SIMPLE_RADIAL 3072 2304 2559.81 1536 1152 -0.0204997");
  EXPECT_NEAR(radial.k1.to_double(), -0.0205, 1e-4);
  EXPECT_NEAR(radial.cx.to_double(), 1535.5, 0.01);
  EXPECT_NEAR(of("1 RADIAL 640 480 500 320 240 0.05 0.001").k1.to_double(), 0.05, 1e-4);
  const auto opencv = of("1 OPENCV 640 480 500 502 320 241 0.05 0.001 0.0001 0.0002");
  EXPECT_NEAR(opencv.fy.to_double(), 502, 0.01);
  EXPECT_NEAR(opencv.cy.to_double(), 240.5, 0.01);
  EXPECT_NEAR(opencv.k1.to_double(), 0.05, 1e-4);
}

TEST(ColmapCamera, RefusesWhatItCannotPutRight) {
  const auto error = [](const std::string& lines) {
    try {
      static_cast<void>(parse_colmap_calibration(kHead + lines, "cameras.txt"));
    } catch (const SegmentProblem& problem) {
      return problem.message();
    }
    return std::string("accepted");
  };
  EXPECT_NE(error("1 FULL_OPENCV 640 480 500 500 320 240 0 0 0 0 0 0 0 0\n").find("cameras.txt:4: has a camera model"),
            std::string::npos);
  EXPECT_NE(error("1 RADIAL 640 480 500 320 240 0.05 0.3\n").find("more than 2 px"), std::string::npos);
  EXPECT_NE(error("1 PINHOLE 640 480 500 320 240\n").find("has 5 numbers"), std::string::npos);
  EXPECT_NE(error("1 PINHOLE 640 480 0 500 320 240\n").find("no camera has"), std::string::npos);
  const std::string one = "1 PINHOLE 640 480 500 500 320 240\n";
  EXPECT_EQ(error(one + "2 PINHOLE 640 480 500 500 320 240\n"), "accepted") << "each image its own, all the same";
  EXPECT_NE(error(one + "2 PINHOLE 640 480 510 500 320 240\n").find("cameras.txt:5: is a second camera"),
            std::string::npos);
  EXPECT_FALSE(is_colmap_calibration("image,x,y,heading\na,1,2,3\n"));
  EXPECT_FALSE(is_colmap_calibration("$FPCAM,test,1,2\n"));
  EXPECT_FALSE(is_colmap_calibration(""));
}

}  // namespace
}  // namespace fencepost::host
