// Calibration of one camera on one robot.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

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

/// How the angle between a ray and the optical axis becomes a distance from the principal point.
enum class Lens : std::uint8_t {
  kPinhole,      ///< f tan(angle)
  kEquidistant,  ///< f angle: fisheyes, to 150 degrees across
};
constexpr std::string_view name(Lens lens) { return lens == Lens::kEquidistant ? "equidistant" : "pinhole"; }

/// One radial coefficient. Pinhole: x_d = x_u (1 + k1 r_u^2) in normalised coordinates; equidistant: r_d = a (1 + k1
/// a^2), where a is the angle from the axis in rad.
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
  Lens lens = Lens::kPinhole;
  friend constexpr bool operator==(const CameraIntrinsics&, const CameraIntrinsics&) = default;
};

}  // namespace fencepost::sensor
