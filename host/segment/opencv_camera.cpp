#include "host/segment/opencv_camera.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <system_error>
#include <vector>

#include "host/segment/pinhole.hpp"
#include "host/segment/problem.hpp"

namespace fencepost::host {
namespace {

constexpr const char* kRemedy = "it is as OpenCV's calibration sample or ROS's camera_calibration writes it";

[[noreturn]] void fail(const std::string& name, const std::string& what) { throw SegmentProblem{name, what, kRemedy}; }

/// The text behind a key at a line's beginning, up to the next such key.
/// Indented lines belong to it, and a list whose lines are not indented.
std::string_view value_of(std::string_view text, const std::string& key, const std::string& name) {
  std::size_t begin = ("\n" + std::string(text)).find("\n" + key + ":");
  if (begin == std::string_view::npos) fail(name, "has no " + key);
  begin += key.size() + 1;
  std::size_t end = begin;
  do {
    end = text.find('\n', end + 1);
  } while (end + 1 < text.size() && end != std::string_view::npos && std::strchr(" -\r\n#", text[end + 1]) != nullptr);
  return text.substr(begin, end == std::string_view::npos ? end : end - begin);
}

/// The numbers of a list: "[1, 2]" on one or more lines, or one a line, each behind "- ".
std::vector<double> numbers_in(std::string_view text, const std::string& key, const std::string& name) {
  const bool in_brackets = text.find('[') != std::string_view::npos;
  if (in_brackets) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos) fail(name, "has no end of " + key);
    text = text.substr(text.find('[') + 1, end - text.find('[') - 1);
  }
  std::vector<double> list;
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  const auto skip = [&](const char* characters) {
    while (at != end && std::strchr(characters, *at) != nullptr) ++at;
  };
  for (skip(" \t\r\n"); at != end; skip(" \t\r\n,")) {
    if (!in_brackets && end - at > 1 && at[0] == '-' && at[1] == ' ') at += 2;
    skip(" +");
    double value = 0;
    const auto [stopped, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value)) fail(name, "has something else than numbers in " + key);
    list.push_back(value);
    at = stopped;
  }
  if (list.empty()) fail(name, "has no " + key);
  return list;
}

double number(std::string_view text, const std::string& key, const std::string& name) {
  return numbers_in(value_of(text, key, name), key, name).front();
}

/// Numbers of a matrix: those behind its "data:".
std::vector<double> numbers(std::string_view text, const std::string& key, const std::string& name) {
  const std::string_view matrix = value_of(text, key, name);
  const std::size_t data = matrix.find("data:");
  if (data == std::string_view::npos) fail(name, "has no data of " + key);
  return numbers_in(matrix.substr(data + 5), key, name);
}

}  // namespace

bool is_opencv_calibration(std::string_view text) {
  return !text.starts_with("$") && text.find("camera_matrix:") != std::string_view::npos;
}

sensor::CameraIntrinsics parse_opencv_calibration(std::string_view text, const std::string& name) {
  const std::vector<double> k = numbers(text, "camera_matrix", name);
  const std::vector<double> d = numbers(text, "distortion_coefficients", name);
  if (k.size() != 9) throw SegmentProblem{name, "has numbers that no camera has", kRemedy};
  Pinhole pinhole{number(text, "image_width", name), number(text, "image_height", name), k[0], k[4], k[2], k[5], {}};
  std::copy_n(d.begin(), std::min(d.size(), pinhole.distortion.size()), pinhole.distortion.begin());
  return to_camera(pinhole, "opencv", name, "calibrate with CALIB_FIX_K2, CALIB_FIX_K3 and CALIB_ZERO_TANGENT_DIST");
}

}  // namespace fencepost::host
