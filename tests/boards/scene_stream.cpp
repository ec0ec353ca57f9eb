#include "tests/boards/scene_stream.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "firmware/record/stream_reader.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/firmware/loop/desk.hpp"

namespace fencepost::test {
namespace {

struct Collector {
  SceneStream& stream;

  void accept(const sensor::CameraIntrinsics& camera) { stream.calibration.push_back(line_of(camera)); }
  void accept(const record::Signature& signature) { stream.calibration.push_back(line_of(signature)); }
  void accept(const sensor::OdometrySample& sample) { stream.inputs.emplace_back(sample); }
  void accept(const sensor::BlobFrame& frame) { stream.inputs.emplace_back(frame); }
  template <class Record>
  void accept(const Record& /*record*/) {}
};

host::SceneObject box(const char* name, std::uint8_t signature, double x, double y, double half, double height) {
  host::SceneObject object;
  object.name = name;
  object.signature = signature;
  object.height_m = height;
  object.footprint.outer = {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
  return object;
}

}  // namespace

std::vector<sensor::OdometrySample> SceneStream::way() const {
  std::vector<sensor::OdometrySample> poses;
  for (const Input& input : inputs) {
    if (const auto* pose = std::get_if<sensor::OdometrySample>(&input)) poses.push_back(*pose);
  }
  return poses;
}

SceneStream stream_of(const host::Scene& scene) {
  SceneStream stream;
  const auto done = host::simulate(scene, [&](std::string_view line) { stream.log += line; });
  if (!done) throw std::runtime_error(done.error());
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  Collector collector{stream};
  reader.push(stream.log, collector);
  return stream;
}

host::Scene recorded_scene(const std::string& name) {
  const auto scene = host::load_scene(FENCEPOST_SOURCE_DIR "/host/share/recordings/" + name + ".json");
  if (!scene) throw std::runtime_error(scene.error().message());
  return *scene;
}

host::Scene minute_scene(double seconds, double rate) {
  host::Scene scene = recorded_scene("blocks_arc");
  scene.rate = rate;
  scene.objects = {box("first", 1, -0.25, 0.1, 0.05, 0.15), box("second", 2, 0.2, 0.2, 0.06, 0.2),
                   box("third", 3, 0.05, -0.25, 0.04, 0.25)};
  scene.signatures = {
      {1, "red", {0xd0, 0x20, 0x20}}, {2, "yellow", {0xd8, 0xc0, 0x20}}, {3, "green", {0x20, 0xa0, 0x40}}};
  host::ArcPath arc;
  arc.center = {0, 0};
  arc.radius = 1.1;
  arc.start = -std::numbers::pi / 2;
  arc.sweep = 4 * std::numbers::pi * seconds / 60;
  arc.views = static_cast<int>(std::lround(seconds * scene.rate));
  scene.path = arc;
  return scene;
}

host::Scene box_beside_the_way(const sensor::CameraIntrinsics& camera) {
  host::Scene scene;
  scene.seed = 5;
  scene.camera = camera;
  scene.rate = 10;
  scene.signatures = {{1, "red", {0xd0, 0x20, 0x20}}};
  scene.objects = {box("beside", 1, 1.4, 0.22, 0.05, 0.3)};
  scene.path = host::WaypointPath{{{0, 0}, {1.1, 0}}, 0.15, 0.8};
  return scene;
}

host::Scene four_boxes(double seconds) {
  host::Scene scene = minute_scene(seconds);
  scene.objects = {box("first", 1, 0.28, 0, 0.05, 0.2), box("second", 2, -0.28, 0.05, 0.04, 0.15),
                   box("third", 3, 0, 0.3, 0.05, 0.2), box("fourth", 4, 0, -0.3, 0.06, 0.25)};
  scene.signatures.push_back({4, "blue", {0x20, 0x40, 0xc0}});
  auto& arc = std::get<host::ArcPath>(scene.path);
  arc.radius = 1.2;
  arc.sweep = 0.6 * seconds;
  return scene;
}

host::Scene eight_boxes(double seconds) {
  host::Scene scene = minute_scene(seconds);
  scene.rate = 50;
  scene.objects.clear();
  scene.signatures.clear();
  for (int i = 0; i < 8; ++i) {
    const double angle = 2 * std::numbers::pi * i / 8;
    // A Pixy2 has seven signatures: two boxes on opposite sides share one.
    const auto id = static_cast<std::uint8_t>(i < 7 ? i + 1 : 4);
    scene.objects.push_back(box("box", id, 0.35 * std::cos(angle), 0.35 * std::sin(angle), 0.025, 0.1 + 0.02 * i));
    if (i < 7) scene.signatures.push_back({id, "colour", {0x20, 0x20, id}});
  }
  auto& arc = std::get<host::ArcPath>(scene.path);
  arc.radius = 1.3;
  arc.sweep = 0.2 * seconds;
  arc.views = static_cast<int>(std::lround(seconds * scene.rate));
  return scene;
}

}  // namespace fencepost::test
