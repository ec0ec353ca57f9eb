// The parameters that calibration estimates: of the camera, the wheels, each object, the way driven.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace fencepost::host {

/// Parameters of the camera. kFocal is the natural logarithm of the focal length over the configured one. All others
/// are absolute: rad, s, m.
enum CameraParameter : std::size_t {
  kFocal,
  kYaw,
  kPitch,
  kLatency,
  kHeight,
  kMountX,
  kMountY,
  kK1,
  kCameraParameters
};

/// Parameters of the odometry: true way / reported way - 1, true turn / reported turn - 1, rad of turn that each metre
/// adds unreported.
enum WheelParameter : std::size_t { kStep, kTurn, kCurve, kWheelParameters };

/// An object's footprint by its support function r + sum of harmonics about (x, y), as the hybrid has it, and its top.
enum ObjectParameter : std::size_t { kCentreX, kCentreY, kTop, kRadius, kShape };
inline constexpr std::size_t kLastHarmonic = 6;  ///< the next one of a square is 3 % of its radius: below a pixel
inline constexpr std::size_t kObjectParameters = kShape + 2 * (kLastHarmonic - 1);

/// Shared by all objects of a signature. kPad: how far each edge of a box lies outside of the thing, px. kWidthRatio:
/// the natural logarithm of the true width over the configured one.
enum KindParameter : std::size_t { kPad, kWidthRatio, kKindParameters };

enum PoseParameter : std::size_t { kPoseX, kPoseY, kPoseHeading, kPoseParameters };

using CameraValues = std::array<double, kCameraParameters>;
using WheelValues = std::array<double, kWheelParameters>;
using ObjectValues = std::array<double, kObjectParameters>;
using KindValues = std::array<double, kKindParameters>;
using PoseValues = std::array<double, kPoseParameters>;

struct Estimate {
  CameraValues camera{};
  WheelValues wheels{};
  std::vector<ObjectValues> objects;
  std::vector<PoseValues> nodes;  ///< world_T_robot at the problem's node times
  std::vector<KindValues> kinds;  ///< of each signature that has an object
};

inline constexpr std::size_t kCalibrated = std::size_t{kCameraParameters} + std::size_t{kWheelParameters};
/// Camera first, then wheels.
constexpr std::size_t place_of(WheelParameter parameter) { return std::size_t{kCameraParameters} + parameter; }
/// Behind the wheels.
constexpr std::size_t place_of(std::size_t kind, KindParameter parameter) {
  return kCalibrated + kKindParameters * kind + parameter;
}
using CalibratedMatrix = std::vector<std::vector<double>>;

}  // namespace fencepost::host
