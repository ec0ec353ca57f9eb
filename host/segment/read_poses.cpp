#include "host/segment/read_poses.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "host/import/text_lines.hpp"
#include "host/segment/camera_path.hpp"
#include "host/segment/problem.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host {
namespace {

constexpr double kLongestGap = 0.2;   // s between poses
constexpr double kSameTime = 0.001;   // s: names are rounded
constexpr double kMuchPitch = 0.035;  // rad, 2 deg

std::string text_of(const char* form, double value) {
  char shown[64];
  std::snprintf(shown, sizeof shown, form, value);
  return shown;
}

std::optional<double> time_in_name(const std::string& image) {
  const auto number = number_in(std::filesystem::path(image).stem().string());
  if (!number) return std::nullopt;
  return seconds_of(*number);
}

/// Between two poses the shortest way, at constant speeds.
std::optional<CameraStand> stand_at(const std::vector<CameraStand>& path, double t) {
  const auto after = std::ranges::lower_bound(path, t - kSameTime, {}, &CameraStand::t);
  if (after == path.end()) return std::nullopt;
  if (std::abs(after->t - t) <= kSameTime) return *after;
  if (after == path.begin()) return std::nullopt;
  const CameraStand& a = *(after - 1);
  if (after->t - a.t > kLongestGap) return std::nullopt;
  const double share = (t - a.t) / (after->t - a.t);
  CameraStand stand = *after;
  stand.position = a.position + share * (after->position - a.position);
  const Eigen::Quaterniond from(a.world_r_camera);
  stand.world_r_camera = from.slerp(share, Eigen::Quaterniond(after->world_r_camera)).toRotationMatrix();
  return stand;
}

/// Finds each image's pose by its time. `unplaced`: images with a time at which there is no pose.
std::vector<CameraStand> stands_of(const std::vector<CameraStand>& path, const std::vector<std::string>& images,
                                   const std::string& file, std::size_t& unplaced) {
  std::vector<CameraStand> stands;
  for (const std::string& image : images) {
    const auto t = time_in_name(image);
    if (!t) continue;
    if (auto stand = stand_at(path, *t)) {
      stand->image = image;
      stand->t = *t;
      stands.push_back(std::move(*stand));
    } else {
      ++unplaced;
    }
  }
  if (stands.empty()) {
    throw SegmentProblem{file,
                         "has poses from " + text_of("%.3f", path.front().t) + " to " +
                             text_of("%.3f s", path.back().t) + ", and no image is named by a time between them",
                         "name the images by their times, as 1305031102.175304.png, or write image,t,x,y,heading"};
  }
  std::ranges::sort(stands, {}, &CameraStand::t);
  return stands;
}

PosesTable table_of(const std::vector<CameraStand>& stands, const OnFloor& floor, const std::string& file) {
  PosesTable table;
  table.file = file;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    table.rows.push_back({stands[i].line, stands[i].image, floor.poses[i]});
  }
  return table;
}

void note_pitch(const OnFloor& floor, const sensor::CameraMount& mount, PosesTable& table) {
  const bool differs = !mount.pitch || std::abs(mount.pitch->to_double() - floor.pitch) > kMuchPitch;
  if (!differs) return;
  table.notes.push_back("by " + table.file + " the camera looks " + text_of("%.1f deg down", floor.pitch * 180 / M_PI) +
                        text_of(", that is \"pitch\": %.4f in the calibration", floor.pitch) +
                        (mount.pitch ? text_of(", which has %.4f", mount.pitch->to_double()) : ", which has none"));
}

}  // namespace

PosesTable read_poses(std::string_view text, const std::string& file, const std::vector<std::string>& images,
                      const sensor::CameraMount& mount, const FloorOptions& options) {
  const PathFormat format = path_format(text);
  if (format == PathFormat::kTable) return parse_poses(text, file);
  const bool tum = format == PathFormat::kTum;
  std::size_t unplaced = 0;
  const std::vector<CameraStand> stands =
      tum ? stands_of(parse_tum(text, file), images, file, unplaced) : parse_colmap_images(text, file);
  const OnFloor floor = onto_floor(stands, mount, options, file);
  PosesTable table = table_of(stands, floor, file);
  settle_times(table, tum);
  if (!options.of_robot) note_pitch(floor, mount, table);
  if (!tum && options.scale == 1) {
    table.notes.push_back(file + " has lengths without unit: say how many metres one of them is with --scale");
  }
  if (unplaced > 0) {
    table.notes.push_back(plural(unplaced, "image") + " left out: no pose of " + file + " within 0.2 s");
  }
  return table;
}

}  // namespace fencepost::host
