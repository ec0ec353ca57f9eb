// A robot, the floor that it has seen and points of the guard, for tests of its knowledge all around.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>

#include "firmware/recon/guard/front.hpp"
#include "firmware/recon/guard/seen_floor.hpp"
#include "tests/firmware/level_pixy2.hpp"

namespace fencepost::test {

inline constexpr double kDegree = std::numbers::pi / 180;

inline recon::MapPose pose_at(double x, double y, double heading) {
  constexpr double kUnits = recon::kMapUnitsPerMetre;
  return {{static_cast<std::int32_t>(std::lround(x * kUnits)), static_cast<std::int32_t>(std::lround(y * kUnits))},
          static_cast<std::int32_t>(std::lround(1e6 * heading))};
}
inline const recon::MapPose kHome = pose_at(0, 0, 0);

/// A robot that has looked at empty floor in these directions.
inline recon::guard::SeenFloor floor_seen(const recon::MapPose& robot, std::initializer_list<double> degrees) {
  recon::guard::SeenFloor floor;
  const recon::CameraModel camera = recon::make_camera_model(level_pixy2());
  double t = 1;
  for (const double turned : degrees) {
    recon::MapPose pose = robot;
    pose.heading += static_cast<std::int32_t>(std::lround(1e6 * turned * kDegree));
    floor.look(recon::make_waiting({base::Time::nearest(t), 1, {}}, 0), camera, pose);
    t += 0.2;
  }
  return floor;
}
/// All around.
inline recon::guard::SeenFloor floor_seen_around(const recon::MapPose& robot) {
  return floor_seen(robot, {0, 40, 80, 120, 160, 200, 240, 280, 320});
}

/// A point that many frames have seen.
inline recon::guard::Front front_at(double x, double y) {
  recon::guard::Front front;
  front.x = static_cast<std::int16_t>(std::lround(1000 * x));
  front.y = static_cast<std::int16_t>(std::lround(1000 * y));
  front.frames = 0xFF;
  return front;
}

}  // namespace fencepost::test
