// Fronts across the robot's way, and a camera's frames of them: enough of a world to test the guard in.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::test {

/// A flat front at x, from `right` to `left` (m, map axes), taller than the lens. The robot looks along x.
struct FlatFront {
  double x = 0;
  double right = 0;
  double left = 0;
  std::uint8_t signature = 1;
};

/// The camera's frame from (x, y), looking along x. Fronts that hide one another are all in it: boxes may overlap.
inline sensor::BlobFrame flat_view(const std::vector<FlatFront>& world, double x, double y, double t,
                                   std::uint32_t number) {
  constexpr double kFocal = 273.6;
  sensor::BlobFrame frame{base::Time::nearest(t), number, {}};
  for (const FlatFront& front : world) {
    const double depth = front.x - x;
    if (depth < 0.02) continue;
    const double u1 = 157.5 - kFocal * (front.left - y) / depth;
    const double u2 = 157.5 - kFocal * (front.right - y) / depth;
    if (u2 < 0 || u1 > 315) continue;
    sensor::Blob blob;
    blob.signature = front.signature;
    blob.x1 = static_cast<std::int16_t>(std::lround(std::clamp(u1, 0.0, 315.0)));
    blob.x2 = static_cast<std::int16_t>(std::lround(std::clamp(u2, 0.0, 315.0)));
    blob.y1 = 60;
    blob.y2 = static_cast<std::int16_t>(std::lround(std::min(207.0, 103.5 + kFocal * 0.12 / depth - 0.5)));
    static_cast<void>(frame.blobs.push_back(blob));
  }
  return frame;
}

}  // namespace fencepost::test
