#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "host/import/import.hpp"
#include "host/import/table.hpp"
#include "host/import/take.hpp"

namespace fencepost::host {
namespace {

// Lengths of the truck, m; source: the data set's description of its vehicle model.
constexpr double kWheelbase = 2.83;
constexpr double kEncoderLeft = 0.76;  // of the middle of the rear axle: the wheel with the encoder
constexpr double kLaserAhead = 3.78;   // of the rear axle
constexpr double kLaserLeft = 0.5;
constexpr double kVirtualHeight = 2;             // m, of the lens where ranges become ground rows
constexpr double kAhead = std::numbers::pi / 2;  // rad, of the laser's bearings
constexpr double kMaxVictoriaBearing = 1.3;      // rad off the axis, with the trunk: the lens ends at 75 degrees
constexpr int kTree = 1;

constexpr double kVictoriaFocal = 1'000;  // px/rad
// The laser has half a degree a beam: 8.7 columns.
constexpr const char* kBeamNoise = "8.70";

sensor::CameraIntrinsics victoria_camera(const VictoriaOptions& options) {
  sensor::CameraIntrinsics camera;
  camera.model = "victoria";
  camera.lens = sensor::Lens::kEquidistant;
  camera.width = 2'618;  // 150 degrees
  camera.height = 1'201;
  camera.fx = camera.fy = base::Pixels2::nearest(kVictoriaFocal);
  camera.cx = base::Pixels2::nearest((2'618 - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((1'201 - 1) / 2.0);
  camera.mount.x = base::Metres::nearest(options.scale * kLaserAhead);
  camera.mount.y = base::Metres::nearest(options.scale * kLaserLeft);
  if (!options.rows) return camera;
  camera.mount.z = base::Metres::nearest(options.scale * kVirtualHeight);
  camera.mount.pitch = base::Radians{0};
  return camera;
}

struct Trunk {
  double t = 0;
  double range = 0;   // m, of its middle
  double left = 0;    // rad
  double radius = 0;  // m
};

/// The box of a trunk; nothing beside the lens or inside the trunk. Without rows it fills the image from top to bottom.
std::optional<ImportedBlob> box_of(const Trunk& trunk, const sensor::CameraIntrinsics& camera, bool rows) {
  if (trunk.range <= trunk.radius) return std::nullopt;
  const double half = std::asin(trunk.radius / trunk.range);
  if (std::abs(trunk.left) + half > kMaxVictoriaBearing) return std::nullopt;
  ImportedBlob blob;  // continuous edges to inclusive pixels
  blob.signature = kTree;
  blob.x1 = camera.cx.to_double() - kVictoriaFocal * (trunk.left + half) + 0.5;
  blob.x2 = std::max(blob.x1, camera.cx.to_double() - kVictoriaFocal * (trunk.left - half) - 0.5);
  blob.y2 = camera.height - 1;
  if (!rows) return blob;
  // The foot of the near side: an equidistant lens puts a ray at its angle off the axis, towards its direction.
  const double distance = trunk.range - trunk.radius;
  const double ahead = distance * std::cos(trunk.left);
  const double aside = distance * std::sin(trunk.left);
  const double off = std::hypot(aside, kVirtualHeight);
  blob.y2 = camera.cy.to_double() + kVictoriaFocal * std::atan2(off, ahead) * kVirtualHeight / off - 0.5;
  return blob;
}

class VictoriaImport {
 public:
  explicit VictoriaImport(const VictoriaOptions& options) : options_(options), camera_(victoria_camera(options)) {
    taken_.names[kTree] = "tree";
    taken_.settings = {{"camera.noise", kBeamNoise},
                       {"car.wheelbase", std::to_string(options.scale * kWheelbase).substr(0, 5)}};
  }

  Imported run(const std::string& folder) {
    take_inputs(folder + "/inputs.dat");
    take_trunks(folder + "/measurements.dat");
    TakeSettings settings;
    settings.camera = camera_;
    return log_of(std::move(taken_), settings, folder, "import-victoria");
  }

 private:
  [[nodiscard]] bool wanted(double t) const {
    return t >= options_.from.value_or(0) && t < options_.to.value_or(std::numeric_limits<double>::infinity());
  }

  /// Speed and steering hold until the next row.
  void take_inputs(const std::string& path) {
    const Table table = read_space_table(path, 3, "time speed steering");
    std::optional<double> before;
    double speed = 0;
    TakenCar car;
    for (const TableRow& row : table.rows) {
      const double t = row.values[0];
      if (!wanted(t)) continue;
      if (before && t < *before) {
        throw ImportProblem{table.place(row), "is earlier than the row before", "times go up; take the line out"};
      }
      if (before) car.driven += options_.scale * speed * (t - *before);
      const double steering = row.values[2];
      // The wheel with the encoder is on another circle than the middle of the axle.
      speed = row.values[1] / (1 - std::tan(steering) * kEncoderLeft / kWheelbase);
      car.t = t;
      car.steering = steering;
      before = t;
      taken_.car.push_back(car);
    }
    if (taken_.car.empty()) {
      throw ImportProblem{"the window", "holds no odometry", "choose --from and --to within the recording"};
    }
  }

  void take_trunks(const std::string& path) {
    const Table table = read_space_table(path, 4, "time range bearing diameter");
    for (const TableRow& row : table.rows) {
      const Trunk trunk{row.values[0], row.values[1], row.values[2] - kAhead, row.values[3] / 2};
      if (!wanted(trunk.t)) continue;
      if (taken_.frames.empty() || taken_.frames.back().t != trunk.t) taken_.frames.push_back({trunk.t, {}});
      if (auto blob = box_of(trunk, camera_, options_.rows)) {
        taken_.frames.back().blobs.push_back(*blob);
      } else {
        ++taken_.skipped["trunks outside the camera's view"];
      }
    }
  }

  const VictoriaOptions& options_;
  sensor::CameraIntrinsics camera_;
  Taken taken_;
};

}  // namespace

ImportResult import_victoria(const std::string& folder, const VictoriaOptions& options) {
  try {
    if (!(options.scale > 0 && options.scale <= 1)) {
      throw ImportProblem{"--scale", "is out of range", "allowed: more than 0, up to 1"};
    }
    return VictoriaImport(options).run(folder);
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
