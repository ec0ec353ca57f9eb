// Calibration of one camera on one robot.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"

namespace fencepost::sensor {

/// Text fields of the stream hold at most this many characters.
inline constexpr std::size_t kMaxText = 32;
using Text = base::FixedString<kMaxText>;

/// robot_T_camera. The optical axis is parallel to the ground but for `pitch` (positive = looking down).
struct CameraMount {
  base::Metres x;
  base::Metres y;
  base::Metres z;
  base::Radians yaw;
  std::optional<base::Radians> pitch;  ///< empty: unknown, ground rows are then not used
  friend constexpr bool operator==(const CameraMount&, const CameraMount&) = default;
};

/// Pinhole with one radial coefficient: x_d = x_u (1 + k1 r_u^2) in normalised coordinates.
struct CameraIntrinsics {
  Text model;
  std::uint16_t width = 0;   ///< px, at least 2
  std::uint16_t height = 0;  ///< px, at least 2
  base::Pixels2 fx;          ///< px, positive
  base::Pixels2 fy;
  base::Pixels2 cx;  ///< px, pixel-centre coordinates
  base::Pixels2 cy;
  base::Ratio4 k1;
  CameraMount mount;
  base::Duration latency;  ///< first byte minus exposure, not negative
  friend constexpr bool operator==(const CameraIntrinsics&, const CameraIntrinsics&) = default;
};

}  // namespace fencepost::sensor
