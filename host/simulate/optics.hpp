// The ray through each pixel's centre, undistorted and with the camera's true pitch taken in.
#pragma once

#include <vector>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// Rays in the upright camera frame: X ahead in the floor plane, Y left, Z up. A ray is (1, -across, rise) s with
/// s > 0 the distance ahead, metres. Pixels that look backwards or outside the lens's range have no ray.
class PixelRays {
 public:
  /// `pitch`: the true one, rad, positive = looking down.
  PixelRays(const sensor::CameraIntrinsics& camera, double pitch);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// Without pitch and distortion, `across` depends on the column only and `rise` on the row only.
  [[nodiscard]] bool separable() const { return separable_; }
  [[nodiscard]] bool exists(int u, int v) const { return separable_ || exists_[index(u, v)]; }
  [[nodiscard]] double across(int u, int v) const {
    return separable_ ? across_[static_cast<std::size_t>(u)] : across_[index(u, v)];
  }
  [[nodiscard]] double rise(int u, int v) const {
    return separable_ ? rise_[static_cast<std::size_t>(v)] : rise_[index(u, v)];
  }

  /// Least and greatest of `rise` in row v, and of `across` in column u: whole lines can be skipped.
  struct Range {
    double low = 0;
    double high = 0;
  };
  [[nodiscard]] const Range& rise_of_row(int v) const { return rise_of_row_[static_cast<std::size_t>(v)]; }
  [[nodiscard]] const Range& across_of_column(int u) const { return across_of_column_[static_cast<std::size_t>(u)]; }

 private:
  void add_ray(int u, int v, bool usable, double across, double rise);
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(u);
  }

  int width_;
  int height_;
  bool separable_;
  std::vector<double> across_;
  std::vector<double> rise_;
  std::vector<bool> exists_;
  std::vector<Range> rise_of_row_;
  std::vector<Range> across_of_column_;
};

/// Solves r_d = r_u (1 + k1 r_u^2) for r_u >= 0 on the branch that starts at 0; negative when there is none.
double undistorted_radius(double distorted, double k1);
/// The same through the camera's lens; negative also where an equidistant one looks sideways (89 degrees).
double undistorted_radius(double distorted, const sensor::CameraIntrinsics& camera);

}  // namespace fencepost::host
