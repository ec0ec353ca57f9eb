#include "host/segment/camera_path.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "host/import/text_lines.hpp"
#include "host/segment/problem.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kColmapColumns = 10;
constexpr double kUnitLength = 0.01;  // by which a quaternion's may be off: five digits and more are usual

bool is_comment(std::string_view line) { return line.starts_with('#'); }

template <std::size_t N>
std::array<double, N> numbers(const std::vector<std::string_view>& words, const std::string& place, const char* form) {
  std::array<double, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = number_in(words[i]);
    if (!value || !std::isfinite(*value)) {
      throw SegmentProblem{place, quoted(words[i]) + " is not a number", std::string("a line is: ") + form};
    }
    values[i] = *value;
  }
  return values;
}

Eigen::Matrix3d rotation(double w, double x, double y, double z, const std::string& place) {
  const Eigen::Quaterniond q(w, x, y, z);
  if (std::abs(q.norm() - 1) > kUnitLength) {
    throw SegmentProblem{place, "has a quaternion whose length is not 1", "check the order of its columns"};
  }
  return q.normalized().toRotationMatrix();
}

constexpr const char* kColmapForm = "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME";
constexpr const char* kTumForm = "timestamp tx ty tz qx qy qz qw";

/// The name is the rest of the line, blanks included.
std::string name_in(std::string_view line, std::string_view last_before) {
  const auto at = static_cast<std::size_t>(last_before.data() + last_before.size() - line.data());
  return std::string(trimmed_text(line.substr(at)));
}

/// The world as the camera sees it: x_camera = R x_world + t.
CameraStand colmap_stand(std::string_view line, const std::string& place) {
  const std::vector<std::string_view> words = words_of(line);
  if (words.size() < kColmapColumns) {
    throw SegmentProblem{place, "has " + plural(words.size(), "column"), std::string("a line is: ") + kColmapForm};
  }
  const auto v = numbers<kColmapColumns - 1>(words, place, kColmapForm);
  const Eigen::Matrix3d camera_r_world = rotation(v[1], v[2], v[3], v[4], place);
  CameraStand stand;
  stand.image = name_in(line, words[kColmapColumns - 2]);
  stand.world_r_camera = camera_r_world.transpose();
  stand.position = -(stand.world_r_camera * Eigen::Vector3d(v[5], v[6], v[7]));
  return stand;
}

}  // namespace

PathFormat path_format(std::string_view text) {
  for (const std::string_view line : lines_of(text)) {
    const std::string_view shown = trimmed_text(line);
    if (shown.empty() || is_comment(shown)) continue;
    const std::vector<std::string_view> words = words_of(shown);
    const auto leading = static_cast<std::size_t>(
        std::ranges::find_if(words, [](std::string_view word) { return !number_in(word); }) - words.begin());
    if (words.size() == kTumColumns && leading == kTumColumns) return PathFormat::kTum;
    if (words.size() >= kColmapColumns && leading >= kColmapColumns - 1) return PathFormat::kColmap;
    break;
  }
  return PathFormat::kTable;
}

std::vector<CameraStand> parse_colmap_images(std::string_view text, const std::string& file) {
  std::vector<CameraStand> stands;
  bool points = false;  // the line behind an image's, which may be empty
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (points) {
      points = false;
      continue;
    }
    const std::string_view shown = trimmed_text(line);
    if (shown.empty() || is_comment(shown)) continue;
    const std::string place = file + ":" + std::to_string(number);
    stands.push_back(colmap_stand(shown, place));
    stands.back().line = number;
    points = true;
  }
  std::ranges::stable_sort(stands, {}, &CameraStand::image);
  const auto twice = std::ranges::adjacent_find(stands, {}, &CameraStand::image);
  if (twice != stands.end()) {
    throw SegmentProblem{file + ":" + std::to_string((twice + 1)->line), quoted(twice->image) + " is there twice",
                         "take one of the lines out"};
  }
  return stands;
}

std::vector<CameraStand> parse_tum(std::string_view text, const std::string& file) {
  std::vector<CameraStand> stands;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const std::string_view shown = trimmed_text(line);
    if (shown.empty() || is_comment(shown)) continue;
    const std::string place = file + ":" + std::to_string(number);
    const std::vector<std::string_view> words = words_of(shown);
    if (words.size() != kTumColumns) {
      throw SegmentProblem{place, "has " + plural(words.size(), "column"), std::string("a line is: ") + kTumForm};
    }
    const auto v = numbers<kTumColumns>(words, place, kTumForm);
    CameraStand stand;
    stand.line = number;
    stand.t = seconds_of(v[0]);
    stand.position = {v[1], v[2], v[3]};
    stand.world_r_camera = rotation(v[7], v[4], v[5], v[6], place);
    if (!stands.empty() && stand.t <= stands.back().t) {
      throw SegmentProblem{place, "is not later than the line before", "sort the lines by their time"};
    }
    stands.push_back(std::move(stand));
  }
  return stands;
}

}  // namespace fencepost::host
