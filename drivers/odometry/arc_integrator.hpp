// A pose from distances and headings, arc by arc.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::odometry {

/// world_T_robot in integers, so that no rounding is lost: the pose starts at the origin, looking along x.
/// Between two calls the robot is assumed to drive a circular arc, which is exact for steady wheels. The chord of an
/// arc of length d and angle a is d sin(a/2) / (a/2) long and points along the middle heading. Source: Borenstein,
/// Where am I?, 1996, section 1.3. Each chord is within 2e-7 of its length.
class ArcIntegrator {
 public:
  /// `distance_pm` of the robot's origin since the last call, backwards negative. `heading_urad` now, continuous (not
  /// wrapped), counted from the start. It comes from sums of counts, so its rounding errors do not accumulate.
  void advance(std::int64_t distance_pm, std::int64_t heading_urad);

  /// Heading wrapped to +-pi; positions end at +-200 km.
  [[nodiscard]] sensor::OdometrySample sample(base::Time t) const;
  [[nodiscard]] std::int64_t heading_urad() const { return heading_urad_; }

 private:
  std::int64_t x_pm_ = 0;
  std::int64_t y_pm_ = 0;
  std::int64_t heading_urad_ = 0;
};

/// num / den, nearest, half away from zero; den positive.
constexpr std::int64_t divide_nearest(std::int64_t num, std::int64_t den) {
  return (num + (num < 0 ? -den / 2 : den / 2)) / den;
}

}  // namespace fencepost::odometry
