// The report of a blob camera: coloured boxes. Image u right, v down, an integer coordinate is a pixel centre.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"

namespace fencepost::sensor {

struct Rgb {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend constexpr bool operator==(Rgb, Rgb) = default;
};

/// One box. [x1,x2] x [y1,y2] inclusive, so its continuous edges are x1-0.5, x2+0.5, y1-0.5, y2+0.5. A bearing has a
/// centre and no width: x1 and x2 are the columns around `cx`, see put_at_centre().
struct Blob {
  std::uint8_t signature = 0;
  std::int16_t x1 = 0;
  std::int16_t y1 = 0;
  std::int16_t x2 = 0;
  std::int16_t y2 = 0;
  base::Pixels1 cx;  ///< centroid
  base::Pixels1 cy;
  std::uint32_t pixels = 0;  ///< area; 0 where the sensor does not tell
  std::optional<Rgb> rgb;    ///< mean colour; empty where the sensor does not tell
  bool bearing = false;      ///< the sensor tells the direction to the middle of the thing, not its width
  std::uint16_t track = 0;   ///< id that a tracking sensor gives the thing from frame to frame; 0: none
  friend constexpr bool operator==(const Blob&, const Blob&) = default;
};

/// Gives a bearing its columns: the middle of [x1,x2] is the multiple of half a pixel nearest to `cx`.
constexpr void put_at_centre(Blob& bearing) {
  constexpr std::int32_t kPerHalf = base::Pixels1::kPerUnit / 2;
  constexpr std::int32_t kPositive = 1 << 17;  // more halves than any centre has: divisions round down
  const std::int32_t halves = (bearing.cx.raw + kPerHalf / 2 + kPositive * kPerHalf) / kPerHalf - kPositive;
  bearing.x1 = static_cast<std::int16_t>(halves >> 1);
  bearing.x2 = static_cast<std::int16_t>((halves + 1) >> 1);
}

inline constexpr std::size_t kMaxBlobs = 16;

/// One camera frame; blobs largest first. `t` is when its first byte arrived; its exposure is `t - latency`.
struct BlobFrame {
  base::Time t;
  std::uint32_t frame = 0;  ///< the camera's own count, wraps
  base::FixedVector<Blob, kMaxBlobs> blobs;
  friend constexpr bool operator==(const BlobFrame&, const BlobFrame&) = default;
};

}  // namespace fencepost::sensor
