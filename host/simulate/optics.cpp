#include "host/simulate/optics.hpp"

#include <cmath>
#include <limits>

namespace fencepost::host {

double undistorted_radius(double distorted, double k1) {
  double limit = std::numeric_limits<double>::infinity();
  if (k1 < 0) {
    limit = std::sqrt(-1 / (3 * k1));  // there the image folds back
    if (distorted > limit * (1 + k1 * limit * limit)) return -1;
  }
  double radius = k1 < 0 ? std::fmin(distorted, limit) : distorted / (1 + k1 * distorted * distorted);
  // Newton from the side on which the cubic is monotonic towards the root; quadratic, 50 is far more than needed.
  for (int i = 0; i < 50; ++i) {
    const double slope = 1 + 3 * k1 * radius * radius;
    if (slope <= 0) break;
    const double step = (radius * (1 + k1 * radius * radius) - distorted) / slope;
    radius = std::fmin(std::fmax(radius - step, 0.0), limit);
    if (std::abs(step) <= 1e-16 * radius) break;
  }
  return radius;
}

double undistorted_radius(double distorted, const sensor::CameraIntrinsics& camera) {
  constexpr double kSideways = 1.553;  // rad
  const double radius = undistorted_radius(distorted, camera.k1.to_double());
  if (camera.lens == sensor::Lens::kPinhole) return radius;
  return radius < 0 || radius > kSideways ? -1 : std::tan(radius);
}

PixelRays::PixelRays(const sensor::CameraIntrinsics& camera, double pitch)
    : width_(camera.width),
      height_(camera.height),
      separable_(pitch == 0 && camera.k1.raw == 0 && camera.lens == sensor::Lens::kPinhole) {
  // A ray less than this far ahead per unit of length looks straight up, down or backwards.
  constexpr double kAhead = 0.05;
  const double cx = camera.cx.to_double();
  const double cy = camera.cy.to_double();
  const double fx = camera.fx.to_double();
  const double fy = camera.fy.to_double();
  if (separable_) {
    for (int u = 0; u < width_; ++u) across_.push_back((u - cx) / fx);
    for (int v = 0; v < height_; ++v) rise_.push_back((cy - v) / fy);
    return;
  }
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  rise_of_row_.assign(camera.height, {kInfinity, -kInfinity});
  across_of_column_.assign(camera.width, {kInfinity, -kInfinity});
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const double xd = (u - cx) / fx;
      const double yd = (v - cy) / fy;
      const double distorted = std::hypot(xd, yd);
      const double radius = undistorted_radius(distorted, camera);
      const double scale = distorted > 0 ? radius / distorted : 1;
      const double down = yd * scale;
      const double ahead = std::cos(pitch) - down * std::sin(pitch);
      const bool usable = radius >= 0 && ahead > kAhead;
      const double rise = -(std::sin(pitch) + down * std::cos(pitch)) / ahead;
      add_ray(u, v, usable, xd * scale / ahead, rise);
    }
  }
}

void PixelRays::add_ray(int u, int v, bool usable, double across, double rise) {
  exists_.push_back(usable);
  across_.push_back(usable ? across : 0);
  rise_.push_back(usable ? rise : 0);
  if (!usable) return;
  Range& row = rise_of_row_[static_cast<std::size_t>(v)];
  row = {std::fmin(row.low, rise), std::fmax(row.high, rise)};
  Range& column = across_of_column_[static_cast<std::size_t>(u)];
  column = {std::fmin(column.low, across), std::fmax(column.high, across)};
}

}  // namespace fencepost::host
