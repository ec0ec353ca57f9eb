#include "host/segment/opencv_camera.hpp"

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

#include "host/segment/image_file.hpp"

namespace fencepost::host {
namespace {

constexpr double kMostPixels = 2;
constexpr const char* kRemedy = "it is as OpenCV's calibration sample or ROS's camera_calibration writes it";

double number(const cv::FileStorage& file, const char* key, const std::string& name) {
  const cv::FileNode node = file[key];
  if (!node.isInt() && !node.isReal()) throw SegmentProblem{name, "has no " + std::string(key), kRemedy};
  return node.real();
}

std::vector<double> numbers(const cv::FileStorage& file, const char* key, const std::string& name) {
  const cv::FileNode node = file[key];
  std::vector<double> list;
  if (node.isMap()) node["data"] >> list;
  if (list.empty()) throw SegmentProblem{name, "has no " + std::string(key), kRemedy};
  return list;
}

cv::FileStorage opened(std::string_view text, const std::string& name) {
  // ROS leaves out the line by which OpenCV knows YAML.
  const std::string whole = (text.starts_with("%YAML") ? "" : "%YAML:1.0\n---\n") + std::string(text);
  try {
    return {whole, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML};
  } catch (const cv::Exception&) {
    throw SegmentProblem{name, "is not YAML that OpenCV reads", kRemedy};
  }
}

/// What the coefficients beyond k1 do to the farthest corner, px.
double beyond_k1(const sensor::CameraIntrinsics& camera, const std::vector<double>& d) {
  const auto at = [&](std::size_t i) { return i < d.size() ? d[i] : 0.0; };
  const double fx = camera.fx.to_double();
  const double x = std::max(camera.cx.to_double(), camera.width - camera.cx.to_double()) / fx;
  const double y = std::max(camera.cy.to_double(), camera.height - camera.cy.to_double()) / camera.fy.to_double();
  const double r2 = x * x + y * y;
  const double radial = std::sqrt(r2) * (std::abs(at(1)) * r2 * r2 + std::abs(at(4)) * r2 * r2 * r2);
  const double tangential = (std::abs(at(2)) + std::abs(at(3))) * 3 * r2;
  return fx * (radial + tangential);
}

}  // namespace

bool is_opencv_calibration(std::string_view text) {
  return !text.starts_with("$") && text.find("camera_matrix:") != std::string_view::npos;
}

sensor::CameraIntrinsics parse_opencv_calibration(std::string_view text, const std::string& name) {
  const cv::FileStorage file = opened(text, name);
  const std::vector<double> k = numbers(file, "camera_matrix", name);
  const std::vector<double> d = numbers(file, "distortion_coefficients", name);
  constexpr double kLargest = 32'767;
  const double width = number(file, "image_width", name);
  const double height = number(file, "image_height", name);
  if (k.size() != 9 || width < 2 || height < 2 || width > kLargest || height > kLargest ||
      !(k[0] > 0 && k[0] < kLargest) || !(k[4] > 0 && k[4] < kLargest) || std::abs(k[2]) > kLargest ||
      std::abs(k[5]) > kLargest || std::abs(d[0]) > 100) {
    throw SegmentProblem{name, "has numbers that no camera has", kRemedy};
  }
  sensor::CameraIntrinsics camera;
  camera.model = "opencv";
  camera.width = static_cast<std::uint16_t>(width);
  camera.height = static_cast<std::uint16_t>(height);
  camera.fx = base::Pixels2::nearest(k[0]);
  camera.fy = base::Pixels2::nearest(k[4]);
  camera.cx = base::Pixels2::nearest(k[2]);
  camera.cy = base::Pixels2::nearest(k[5]);
  camera.k1 = base::Ratio4::nearest(d[0]);
  if (beyond_k1(camera, d) > kMostPixels) {
    throw SegmentProblem{name, "has coefficients beyond k1 that move the image's corners by more than 2 px",
                         "calibrate with CALIB_FIX_K2, CALIB_FIX_K3 and CALIB_ZERO_TANGENT_DIST"};
  }
  return camera;
}

}  // namespace fencepost::host
