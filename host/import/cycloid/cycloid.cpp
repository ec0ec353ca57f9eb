#include <string>
#include <utility>

#include "host/geometry/rings.hpp"
#include "host/import/import.hpp"
#include "host/import/log_builder.hpp"
#include "host/import/table.hpp"
#include "host/import/take.hpp"

namespace fencepost::host {
namespace {

constexpr double kMetre = 100;          // cm
constexpr double kConeRadius = 0.0708;  // m, at the height of the lens; source: cycloid's localiser
constexpr double kConeHeight = 0.15;    // m
constexpr int kConeVertices = 32;
constexpr int kConeSignature = 1;

constexpr double kCycloidFocal = 200;  // px/rad
// Bearings are 31 mrad off (1.8 degrees rms, by a filter that knows the cones): 6.3 columns.
constexpr const char* kEdgeNoise = "6.30";

sensor::CameraIntrinsics cycloid_camera() {
  sensor::CameraIntrinsics camera;
  camera.model = "cycloid";
  camera.lens = sensor::Lens::kEquidistant;
  camera.width = 523;  // 150 degrees
  camera.height = 101;
  camera.fx = camera.fy = base::Pixels2::nearest(kCycloidFocal);
  camera.cx = base::Pixels2::nearest((523 - 1) / 2.0);
  camera.cy = base::Pixels2::nearest((101 - 1) / 2.0);
  return camera;
}

ImportedBlob bearing_of(double right, const sensor::CameraIntrinsics& camera) {
  ImportedBlob blob;
  blob.signature = kConeSignature;
  blob.bearing = true;
  blob.cx = camera.cx.to_double() + kCycloidFocal * right;
  blob.cy = camera.cy.to_double();
  return blob;
}

Taken take_cycloid(const WordTable& table, const sensor::CameraIntrinsics& camera) {
  Taken taken;
  taken.names[kConeSignature] = "cone";
  taken.settings = {{"camera.noise", kEdgeNoise}};
  TakenCar car;
  car.yaw_rate = 0;
  taken.car.push_back(car);
  std::size_t row = 0;
  while (row < table.rows.size()) {
    const WordRow& head = table.rows[row++];
    table.expect_at_least(head, 4, "dt ds gyro n");
    const double step = table.number(head, 0);
    if (!(step > 0)) {
      throw ImportProblem{table.place(head), "has a step of no time", "times go up; correct the line or take it out"};
    }
    car.t += step;
    car.driven += table.number(head, 1) / kMetre;
    car.yaw_rate = table.number(head, 2);
    taken.car.push_back(car);
    TakenFrame frame{car.t, {}};
    for (int left = table.whole(head, 3); left > 0; --left) {
      if (row == table.rows.size()) {
        throw ImportProblem{table.place(head), "announces more bearings than the file has",
                            "check that the copy is complete"};
      }
      frame.blobs.push_back(bearing_of(table.number(table.rows[row++], 0), camera));
    }
    taken.frames.push_back(std::move(frame));
  }
  return taken;
}

/// The first line is their number, every other one a place: cm, in the frame of the start.
Scene cones_of(const std::string& path, const sensor::CameraIntrinsics& camera) {
  const WordTable table = read_words(path);
  Scene scene;
  scene.camera = camera;
  scene.signatures.push_back({kConeSignature, "cone", colour_number(0, 1)});
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    table.expect_at_least(table.rows[i], 2, "x y");
    const Point at{table.number(table.rows[i], 0) / kMetre, table.number(table.rows[i], 1) / kMetre};
    scene.objects.push_back({"cone " + std::to_string(i),
                             kConeSignature,
                             0,
                             kConeHeight,
                             {circle_ring(at, kConeRadius, kConeVertices), {}}});
  }
  if (table.whole(table.rows.front(), 0) != static_cast<int>(scene.objects.size())) {
    throw ImportProblem{
        table.place(table.rows.front()),
        "announces another number of cones than the " + std::to_string(scene.objects.size()) + " that follow",
        "check that the copy is complete"};
  }
  return scene;
}

}  // namespace

ImportResult import_cycloid(const std::string& drive, const std::string& cones) {
  try {
    TakeSettings settings;
    settings.camera = cycloid_camera();
    Imported imported = log_of(take_cycloid(read_words(drive), *settings.camera), settings, drive, "import-cycloid");
    if (!cones.empty()) imported.truth = cones_of(cones, *settings.camera);
    return imported;
  } catch (const ImportProblem& problem) {
    return problem;
  }
}

}  // namespace fencepost::host
