#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "host/import/dlr/dlr_files.hpp"
#include "host/import/import.hpp"
#include "host/import/table.hpp"
#include "host/import/take.hpp"

namespace fencepost::host {
namespace {

constexpr double kDiscThickness = 0.02;  // m, of the virtual disc: its far edge is above the floor, its foot is not
constexpr double kDlrLensHeight = 0.5;   // m, of the virtual camera
constexpr double kMaxBearing = 1.02;     // rad off the axis, with the disc: the virtual image ends there
constexpr int kDiscSignatures = kDlrUnknownDisc - 1;  // of known discs

sensor::CameraIntrinsics dlr_camera() {
  sensor::CameraIntrinsics camera;
  camera.model = "dlr";
  camera.width = 12'000;
  camera.height = 6'000;
  camera.fx = camera.fy = base::Pixels2::nearest(3'600);
  camera.cx = base::Pixels2::nearest((12'000 - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((6'000 - 1) / 2.0);
  camera.mount.z = base::Metres::nearest(kDlrLensHeight);
  camera.mount.pitch = base::Radians{0};
  return camera;
}

/// The box of a disc on the floor; nothing where the robot stands on it or the image ends.
std::optional<ImportedBlob> box_of(const DlrDisc& disc, const sensor::CameraIntrinsics& camera) {
  const double range = std::hypot(disc.x, disc.y);
  if (range <= kDlrDiscRadius) return std::nullopt;
  const double bearing = std::atan2(disc.y, disc.x);
  const double half = std::asin(kDlrDiscRadius / range);
  if (std::abs(bearing) + half > kMaxBearing) return std::nullopt;
  const double f = camera.fx.to_double();
  const double cx = camera.cx.to_double();
  const double cy = camera.cy.to_double();
  ImportedBlob blob;  // continuous edges to inclusive pixels
  blob.x1 = cx - f * std::tan(bearing + half) + 0.5;
  blob.x2 = cx - f * std::tan(bearing - half) - 0.5;
  blob.y1 = cy + f * (kDlrLensHeight - kDiscThickness) / ((range + kDlrDiscRadius) * std::cos(bearing)) + 0.5;
  blob.y2 = cy + f * kDlrLensHeight / ((range - kDlrDiscRadius) * std::cos(bearing)) - 0.5;
  return blob;
}

Taken take_dlr(const std::vector<DlrStep>& steps, const DlrOptions& options, const sensor::CameraIntrinsics& camera) {
  const std::size_t end = std::min(options.to.value_or(steps.size()), steps.size());
  if (options.from >= end) {
    throw ImportProblem{"the window", "holds no step", "there are steps 0 to " + std::to_string(steps.size() - 1)};
  }
  Taken taken;
  TimedPose pose;
  std::map<int, int> order;  // of appearance
  for (std::size_t i = options.from; i < end; ++i) {
    const DlrStep& step = steps[i];
    pose.t = kDlrPeriod * static_cast<double>(i - options.from);
    if (i > options.from) {  // a window starts at the origin
      pose.x += std::cos(pose.heading) * step.forward - std::sin(pose.heading) * step.left;
      pose.y += std::sin(pose.heading) * step.forward + std::cos(pose.heading) * step.left;
      pose.heading += step.turn;
    }
    taken.poses.push_back(pose);
    TakenFrame frame{pose.t, {}};
    for (const DlrDisc& disc : step.discs) {
      auto blob = box_of(disc, camera);
      if (!blob) {
        ++taken.skipped["discs outside the camera's view"];
        continue;
      }
      if (options.identity && disc.id < 0) {
        blob->signature = kDlrUnknownDisc;
      } else if (options.identity) {
        blob->signature =
            1 + order.try_emplace(disc.id, static_cast<int>(order.size())).first->second % kDiscSignatures;
      }
      frame.blobs.push_back(*blob);
    }
    taken.frames.push_back(std::move(frame));
  }
  taken.notes.emplace_back("times are made up: one step every 0.5 s");
  return taken;
}

}  // namespace

std::vector<DlrStep> read_dlr(const std::string& path) {
  const WordTable table = read_words(path);
  std::vector<DlrStep> steps;
  for (const WordRow& row : table.rows) {
    if (row.words[0] == "STEP") {
      table.expect_at_least(row, 5, "STEP image dX dY dPhi");
      // The file's robot looks along -Y, X is to its right: its angles, from X to Y, turn to the right.
      steps.push_back({-table.number(row, 3), -table.number(row, 2), -table.number(row, 4), {}});
    } else if (row.words[0] == "LANDMARK_C") {
      table.expect_at_least(row, 8, "LANDMARK_C pX pY quality cXX cXY cYY ID");
      if (steps.empty()) {
        throw ImportProblem{table.place(row), "is a landmark before the first step", "check that the copy is complete"};
      }
      steps.back().discs.push_back({-table.number(row, 2), -table.number(row, 1), table.whole(row, 7)});
    } else {
      throw ImportProblem{table.place(row), "is neither STEP nor LANDMARK_C", "correct the line or take it out"};
    }
  }
  if (steps.empty()) throw ImportProblem{path, "has no step", "check that the copy is complete"};
  return steps;
}

ImportResult import_dlr(const std::string& path, const DlrOptions& options) {
  try {
    TakeSettings settings;
    settings.camera = dlr_camera();
    return log_of(take_dlr(read_dlr(path), options, *settings.camera), settings, path, "import-dlr");
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
