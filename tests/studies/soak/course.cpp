#include "tests/studies/soak/course.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "firmware/record/stream_reader.hpp"
#include "host/geometry/rings.hpp"
#include "host/scene/table_camera.hpp"
#include "host/simulate/odometer.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/studies/common/random_scene.hpp"

namespace fencepost::test {
namespace {

constexpr double kRadius = 0.95;  // m
constexpr double kSpeed = 2;      // m/s, on the ways between

struct Listener {
  std::vector<Input>& inputs;
  void accept(const sensor::OdometrySample& sample) { inputs.emplace_back(sample); }
  void accept(const sensor::BlobFrame& frame) { inputs.emplace_back(frame); }
  template <class Record>
  void accept(const Record&) {}
};

Piece make_piece(host::Scene scene) {
  Piece piece;
  piece.scene = std::move(scene);
  std::array<char, record::StreamReader::kBuffer> buffer{};
  record::StreamReader reader(buffer);
  Listener listener{piece.inputs};
  const auto summary = host::simulate(piece.scene, [&](std::string_view line) { reader.push(line, listener); });
  if (!summary.ok()) throw std::runtime_error(summary.error());
  const base::Duration last = base::Duration::nearest(summary->duration);
  piece.length = last + host::kOdometryPeriod;
  return piece;
}

}  // namespace

Piece make_lap(unsigned seed, host::Point center) {
  host::Scene scene = random_scene(seed, 3, Colours::kAllDifferent, 1);
  for (host::SceneObject& object : scene.objects) object.footprint = host::moved(object.footprint, 0, center);
  auto& arc = std::get<host::ArcPath>(scene.path);
  arc.center = center;
  arc.radius = kRadius;
  arc.start = 0;
  return make_piece(std::move(scene));
}

Piece make_transfer(host::Point from, host::Point to) {
  host::Scene scene;
  scene.camera = host::table_camera("test");
  scene.rate = 10;
  scene.signatures.push_back({1, "colour 1", {}});
  const double seconds = std::hypot(to.x - from.x, to.y - from.y) / kSpeed;
  host::PosesPath path;
  path.poses.push_back({0, from.x + kRadius, from.y, std::numbers::pi});
  path.poses.push_back({seconds, to.x + kRadius, to.y, std::numbers::pi});
  scene.path = path;
  return make_piece(std::move(scene));
}

}  // namespace fencepost::test
