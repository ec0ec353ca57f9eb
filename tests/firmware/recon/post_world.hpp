// Round posts, seen by a camera that may differ from its calibration: whole pixels, cut by the image's border.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::test {

struct RoundPost {
  std::uint8_t signature = 1;
  double x = 0;
  double y = 0;
  double radius = 0.05;
  double base = 0;  ///< m, of its foot above the floor
};

/// The camera as it is: 316 x 208 pixels, on the robot's axis.
struct TrueCamera {
  double focal = 273.6;  ///< px
  double pitch = 0;      ///< rad, down
  double height = 0.12;  ///< m
  double ahead = 0;      ///< m, of the robot's origin
};

/// The camera's frame from a pose of the robot. Posts that hide one another are both in it.
inline sensor::BlobFrame view_of_posts(const std::vector<RoundPost>& posts, const TrueCamera& camera, double x,
                                       double y, double heading, std::int64_t ticks, std::uint32_t number) {
  constexpr double kTop = 0.1;  // m, of a post above its foot
  sensor::BlobFrame frame{{ticks}, number, {}};
  for (const RoundPost& post : posts) {
    const double dx = post.x - x - camera.ahead * std::cos(heading);
    const double dy = post.y - y - camera.ahead * std::sin(heading);
    const double forward = dx * std::cos(heading) + dy * std::sin(heading);
    const double left = dy * std::cos(heading) - dx * std::sin(heading);
    const double distance = std::hypot(forward, left);
    if (forward < 0.2 || distance < 2 * post.radius) continue;
    const double half = std::asin(post.radius / distance);
    const double bearing = std::atan2(left, forward);
    const double u1 = 157.5 - camera.focal * std::tan(bearing + half);
    const double u2 = 157.5 - camera.focal * std::tan(bearing - half);
    const auto row = [&](double z) {
      return 103.5 + camera.focal * std::tan(std::atan2(camera.height - z, forward - post.radius) - camera.pitch);
    };
    const auto pixel = [](double at, double most) {
      return static_cast<std::int16_t>(std::lround(std::clamp(at, 0.0, most)));
    };
    if (u2 < 0 || u1 > 315 || row(post.base) < 1 || row(post.base + kTop) > 206) continue;
    sensor::Blob blob;
    blob.signature = post.signature;
    blob.x1 = pixel(u1 + 0.5, 315);
    blob.x2 = pixel(u2 - 0.5, 315);
    blob.y1 = pixel(row(post.base + kTop) + 0.5, 207);
    blob.y2 = pixel(row(post.base) - 0.5, 207);
    if (blob.x2 >= blob.x1 && blob.y2 >= blob.y1) static_cast<void>(frame.blobs.push_back(blob));
  }
  return frame;
}

}  // namespace fencepost::test
