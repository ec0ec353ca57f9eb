// Lens distortion: pinhole and equidistant with one radial coefficient (host/share/doc/frames.md). Templates over the
// number type, for derivatives.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/calibrate/problem.hpp"

namespace fencepost::host::calibration {

inline double value_of(double number) { return number; }
/// The value of a number with derivatives.
template <class Number>
double value_of(const Number& number) {
  return number.a;
}

/// Rows and columns over the focal length, of a pinhole -> of the lens: the factor for both.
template <class T>
T distortion(const ConfiguredOptics& optics, const T& k1, const T& across, const T& down) {
  using std::atan;
  using std::sqrt;
  const T square = across * across + down * down;
  if (!optics.equidistant) return 1.0 + k1 * square;
  constexpr double kOnAxis = 1e-6;  // a root has no derivative at 0
  if (value_of(square) < kOnAxis) return 1.0 + (k1 - 1.0 / 3) * square;
  const T radius = sqrt(square);
  const T angle = atan(radius);
  return angle * (1.0 + k1 * angle * angle) / radius;
}

/// Inverse of distortion: the column of a pinhole for a place in the image. `distorted` is left of the axis and `row`
/// down from it, both over the focal length. An equidistant lens counts angles beyond 80 degrees as 80, as on the
/// robot.
template <class T>
T undistorted_column(const ConfiguredOptics& optics, const T& k1, const T& distorted, const T& row) {
  using std::sqrt;
  using std::tan;
  if (!optics.equidistant) {
    T across = distorted;
    for (int i = 0; i < 3; ++i) across = distorted / distortion(optics, k1, across, row);
    return across;
  }
  const T square = distorted * distorted + row * row;
  constexpr double kOnAxis = 1e-6;
  if (value_of(square) < kOnAxis) return distorted;
  const T radius = sqrt(square);
  T angle = radius;
  for (int i = 0; i < 5; ++i) {
    const T slope = 1.0 + 3.0 * k1 * angle * angle;
    if (value_of(slope) < 0.2) break;  // beyond the fold of a strong barrel lens
    angle -= (angle * (1.0 + k1 * angle * angle) - radius) / slope;
  }
  constexpr double kWidest = 1.3963;  // rad
  if (value_of(angle) > kWidest) angle = T(kWidest);
  return distorted * tan(angle) / radius;
}

/// The row in which a box's edge at column `seen` lies; of a pinhole the middle row. In a fisheye an outer edge reaches
/// farthest at the row nearest to the horizon, an inner one at the row farthest from it. `lowered`: px that the horizon
/// lies above the principal point.
inline double row_of_edge(const ConfiguredOptics& optics, double lowered, const Sighting& sighting, double seen,
                          double sign) {
  if (!optics.equidistant) return 0.5 * (sighting.row_low + sighting.row_high);
  const double horizon = optics.cy - lowered;
  const bool outer = (sign > 0) == (seen < optics.cx);
  if (outer) return std::clamp(horizon, sighting.row_low, sighting.row_high);
  return horizon - sighting.row_low > sighting.row_high - horizon ? sighting.row_low : sighting.row_high;
}

/// The ray through a pixel position, as seen from a pitched lens: along the ground straight ahead, to the left, and
/// down.
struct GroundRay {
  double ahead;
  double left;
  double down;
};
inline GroundRay ground_ray(const ConfiguredOptics& optics, const CameraValues& camera, double column, double row) {
  const double scale = std::exp(camera[kFocal]);
  const double u = (optics.cx - column) / (optics.fx * scale);
  const double v = (row - optics.cy) / (optics.fy * scale);
  const double across = undistorted_column<double>(optics, camera[kK1], u, v);
  const double down = undistorted_column<double>(optics, camera[kK1], v, u);
  const double c = std::cos(camera[kPitch]);
  const double s = std::sin(camera[kPitch]);
  return {c - down * s, across, s + down * c};
}

}  // namespace fencepost::host::calibration
