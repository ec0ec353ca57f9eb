#include "host/segment/opencv_camera.hpp"

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "host/segment/image_file.hpp"
#include "host/segment/pinhole.hpp"

namespace fencepost::host {
namespace {

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

}  // namespace

bool is_opencv_calibration(std::string_view text) {
  return !text.starts_with("$") && text.find("camera_matrix:") != std::string_view::npos;
}

sensor::CameraIntrinsics parse_opencv_calibration(std::string_view text, const std::string& name) {
  const cv::FileStorage file = opened(text, name);
  const std::vector<double> k = numbers(file, "camera_matrix", name);
  const std::vector<double> d = numbers(file, "distortion_coefficients", name);
  if (k.size() != 9) throw SegmentProblem{name, "has numbers that no camera has", kRemedy};
  Pinhole pinhole{number(file, "image_width", name), number(file, "image_height", name), k[0], k[4], k[2], k[5], {}};
  std::copy_n(d.begin(), std::min(d.size(), pinhole.distortion.size()), pinhole.distortion.begin());
  return to_camera(pinhole, "opencv", name, "calibrate with CALIB_FIX_K2, CALIB_FIX_K3 and CALIB_ZERO_TANGENT_DIST");
}

}  // namespace fencepost::host
