// The CMUcam family as data: how its members differ.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "hal/base/units.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::cmucam {

/// Meaning of the packet's field `pixels`.
enum class PixelCount : std::uint8_t {
  kUnknown,       ///< its formula is not documented
  kCount,         ///< pixels, 255 and more are 255 (CMUcam3's emulation)
  kEighths,       ///< (pixels + 4) / 8, at most 255 (CMUcam1; recalled, not confirmed)
  kByConfidence,  ///< the confidence is the share of the box that matches, in 255ths (CMUcam4)
};

struct Dialect {
  std::string_view model;   ///< as in FPCAM
  std::string_view banner;  ///< how the camera's version text starts
  std::uint16_t width = 0;  ///< px; with height, the range of the coordinates
  std::uint16_t height = 0;
  std::uint8_t first_pixel = 0;  ///< coordinate of the leftmost column and topmost row: 1 or 0
  bool has_raw = true;           ///< knows raw packets
  base::Pixels2 fx;              ///< px; pixels of the older imagers are wider than tall
  base::Pixels2 fy;
  base::Pixels2 cy;  ///< row of the optical axis: not the middle where rows past 255 cannot be reported
  PixelCount pixels = PixelCount::kUnknown;
  std::uint8_t min_confidence = 0;  ///< below, a box is noise
  std::uint8_t darkest = 16;        ///< least value that the imager gives a channel
  std::uint8_t brightest = 240;     ///< its largest
  base::Duration reset_timeout;     ///< until the version text: some start anew for two seconds
  base::Duration command_timeout;   ///< of a command's ACK
  base::Duration reply_timeout;     ///< of a packet that was asked for; at least three frames
  /// Commands after a reset, before and after the image has settled; few, since each may be damaged on the line.
  std::span<const std::string_view> warm_up;
  std::span<const std::string_view> set_up;
};

/// Firmware 1.12, OV6620 imager. Coordinates 1..80, 1..143.
extern const Dialect kCmuCam1;
/// CMUcam2 with the OV6620 (banner "c6"), low resolution. Coordinates 1..88, 1..143.
extern const Dialect kCmuCam2;
/// The same in high resolution: 1..176, 1..255; the camera has more rows than a byte can say.
extern const Dialect kCmuCam2High;
/// CMUcam2 with the OV7620 of the FRC kits of 2005 and 2006. Coordinates 1..159, 1..239.
extern const Dialect kCmuCam2Ov7620;
/// CMUcam3 running the CMUcam2 emulation: 0-based, 88 x 144. Its version text is a CMUcam2's, so only the user can tell
/// them apart: taken for the other, boxes are off by one pixel.
extern const Dialect kCmuCam3;
/// The same in high resolution: 176 columns, the first 255 of 288 rows.
extern const Dialect kCmuCam3High;
/// CMUcam4, firmware 1.02, 19200 Bd: ASCII only, 0-based, 160 x 120, channels of 0 to 255. It starts anew for two
/// seconds; the waits for that and for ACKs are those of its maker's library.
extern const Dialect kCmuCam4;

/// Nominal calibration. The field of view of 44.1 x 33.7 deg is quoted for the CMUcam2's lens; teams measured 46.6 to
/// 50 deg across. For the other models it is assumed, so calibrate. Latency: one and a half frames of 17 /s (CMUcam4:
/// 30 /s).
sensor::CameraIntrinsics nominal_intrinsics(const Dialect& dialect, const sensor::CameraMount& mount);

}  // namespace fencepost::cmucam
