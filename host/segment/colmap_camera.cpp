#include "host/segment/colmap_camera.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "host/import/text_lines.hpp"
#include "host/segment/pinhole.hpp"
#include "host/segment/problem.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

constexpr double kCorner = 0.5;  // px, from the image's corner to the middle of its first pixel

/// Indices of a model's numbers; -1: it has none.
struct Model {
  std::string_view name;
  std::size_t numbers;
  int fy;
  int cx;
  int k1;
  int k2;
  int p1;
};
constexpr Model kModels[] = {{"SIMPLE_PINHOLE", 3, 0, 1, -1, -1, -1},
                             {"PINHOLE", 4, 1, 2, -1, -1, -1},
                             {"SIMPLE_RADIAL", 4, 0, 1, 3, -1, -1},
                             {"RADIAL", 5, 0, 1, 3, 4, -1},
                             {"OPENCV", 8, 1, 2, 4, 5, 6}};

/// The first line that is no comment, and its number.
struct First {
  std::vector<std::string_view> words;
  std::size_t line = 0;
};
std::vector<First> camera_lines(std::string_view text) {
  std::vector<First> cameras;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    const std::string_view shown = trimmed_text(line);
    if (!shown.empty() && !shown.starts_with('#')) cameras.push_back({words_of(shown), number});
  }
  return cameras;
}

std::vector<double> numbers_of(const First& camera, const std::string& place) {
  std::vector<double> values;
  for (std::size_t i = 2; i < camera.words.size(); ++i) {
    const auto value = number_in(camera.words[i]);
    if (!value)
      throw SegmentProblem{place, quoted(camera.words[i]) + " is not a number", "it is as COLMAP writes cameras.txt"};
    values.push_back(*value);
  }
  return values;
}

sensor::CameraIntrinsics camera_of(const First& line, const std::string& place) {
  const auto* model = std::ranges::find(kModels, line.words[1], &Model::name);
  if (model == std::end(kModels)) {
    throw SegmentProblem{
        place, std::string("has a camera model ") + quoted(line.words[1]) + " that boxes cannot be put right for",
        "let COLMAP use --ImageReader.camera_model SIMPLE_RADIAL, or its image_undistorter"};
  }
  const std::vector<double> values = numbers_of(line, place);
  if (values.size() != 2 + model->numbers) {
    throw SegmentProblem{place, "has " + plural(values.size(), "number"), "it is as COLMAP writes cameras.txt"};
  }
  const auto at = [&](int index) { return index < 0 ? 0.0 : values[2 + static_cast<std::size_t>(index)]; };
  Pinhole pinhole{values[0], values[1], at(0), at(model->fy), at(model->cx) - kCorner, at(model->cx + 1) - kCorner, {}};
  pinhole.distortion = {at(model->k1), at(model->k2), at(model->p1), model->p1 < 0 ? 0 : at(model->p1 + 1), 0};
  return to_camera(pinhole, "colmap", place,
                   "let COLMAP use --ImageReader.camera_model SIMPLE_RADIAL, or its image_undistorter");
}

}  // namespace

bool is_colmap_calibration(std::string_view text) {
  const std::vector<First> cameras = camera_lines(text.substr(0, std::min<std::size_t>(text.size(), 4'096)));
  if (cameras.empty() || cameras.front().words.size() < 5) return false;
  const auto& words = cameras.front().words;
  const auto upper = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
  return number_in(words[0]) && std::ranges::all_of(words[1], upper) && number_in(words[2]) && number_in(words[3]);
}

sensor::CameraIntrinsics parse_colmap_calibration(std::string_view text, const std::string& name) {
  std::optional<sensor::CameraIntrinsics> camera;
  for (const First& line : camera_lines(text)) {
    const std::string place = name + ":" + std::to_string(line.line);
    if (line.words.size() < 5) throw SegmentProblem{place, "is no camera", "it is as COLMAP writes cameras.txt"};
    const sensor::CameraIntrinsics next = camera_of(line, place);
    if (camera && !(*camera == next)) {
      throw SegmentProblem{place, "is a second camera that differs from the first",
                           "let COLMAP use --ImageReader.single_camera 1, or give a file with one of them"};
    }
    camera = next;
  }
  return *camera;
}

}  // namespace fencepost::host
