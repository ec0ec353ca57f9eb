// A robot that drives two rounds among blocks, with odometry as good as a test wants.
#pragma once

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/geometry/rings.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/simulate.hpp"

namespace fencepost::host::test {

struct RoundTrip {
  std::string log;
  Scene scene;
  std::vector<TimedPose> way;
};

struct RoundTripOptions {
  std::uint64_t seed = 1;
  double drift = 0;  ///< 0.03: 3 % of the way, 3 degrees a metre and a walk of 1 cm per root metre
  double edge_px = 0.7;
  int blocks = 6;
  double fisheye = 0;  ///< degrees across of an equidistant lens; 0: a Pixy2's
  bool one_colour = false;
};

/// Blocks of 8 cm around a circle of 0.7 m radius that the robot drives around two and a half times.
inline RoundTrip round_trip(const RoundTripOptions& options) {
  RoundTrip trip;
  Scene& scene = trip.scene;
  scene.seed = static_cast<unsigned>(options.seed);
  scene.rate = 10;
  sensor::CameraIntrinsics& camera = scene.camera;
  camera.model = "pixy2";
  camera.width = 316;
  camera.height = 208;
  camera.fx = camera.fy = base::Pixels2::nearest(273.6);
  if (options.fisheye > 0) {
    camera.lens = sensor::Lens::kEquidistant;
    camera.fx = camera.fy = base::Pixels2::nearest(camera.width / (options.fisheye * std::numbers::pi / 180));
  }
  camera.cx = base::Pixels2::nearest(157.5);
  camera.cy = base::Pixels2::nearest(103.5);
  camera.mount.x = base::Metres::nearest(0.05);
  camera.mount.z = base::Metres::nearest(0.12);
  camera.mount.pitch = base::Radians::nearest(0.0);
  camera.latency = base::Duration::nearest(0.05);
  constexpr double kRadius = 0.7;
  constexpr double kSpeed = 0.2;
  const double turns = 2.5 * 2 * std::numbers::pi;
  for (double t = 0; t * kSpeed / kRadius < turns; t += 0.02) {
    const double angle = t * kSpeed / kRadius;
    trip.way.push_back({t, kRadius * std::sin(angle), kRadius * (1 - std::cos(angle)), angle});
  }
  scene.path = PosesPath{trip.way};
  for (int i = 0; i < options.blocks; ++i) {
    const double angle = 2 * std::numbers::pi * i / options.blocks + 0.3;
    const Point at{1.5 * std::cos(angle), kRadius + 1.5 * std::sin(angle)};
    SceneObject object;
    object.name = "block " + std::to_string(i + 1);
    object.signature = static_cast<std::uint8_t>(options.one_colour ? 1 : i + 1);
    object.height_m = 0.2;
    object.footprint = {circle_ring(at, 0.04), {}};
    scene.objects.push_back(object);
    if (i == 0 || !options.one_colour) scene.signatures.push_back({object.signature, object.name, {200, 30, 30}});
  }
  scene.noise.edge_px = options.edge_px;
  scene.noise.drift_scale = options.drift;
  scene.noise.drift_turn = options.drift * 100 * std::numbers::pi / 180;
  scene.noise.drift_walk = options.drift / 3;
  const auto simulated = simulate(scene, [&](std::string_view line) { trip.log += line; });
  if (!simulated) throw std::runtime_error(simulated.error());
  return trip;
}

}  // namespace fencepost::host::test
