// A drive towards a post, as a camera and wheels see it.
#pragma once

#include <algorithm>
#include <atomic>

#include "hal/linux/clock.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::guest {

/// Is stationary until drive(), then goes straight ahead at 0.05 m/s for 0.2 m. The post is 0.1 m wide, 0.2 m high and
/// 1.2 m ahead of the start. The camera is 0.12 m above the robot's middle. Any thread may ask.
class Approach {
 public:
  static constexpr double kLength = 0.2;

  void drive() { began_ = clock_.now().raw; }
  [[nodiscard]] base::Time now() const { return clock_.now(); }
  /// m
  [[nodiscard]] double way() const {
    const std::int64_t began = began_;
    if (began < 0) return 0;
    return std::min(kLength, 0.05 * static_cast<double>(now().raw - began) / base::Time::kPerUnit);
  }
  [[nodiscard]] sensor::Blob post(const sensor::CameraIntrinsics& camera) const {
    const double depth = 1.2 - way();
    const auto column = [&](double y) { return at(camera.cx.to_double() - camera.fx.to_double() * y / depth); };
    const auto row = [&](double z) { return at(camera.cy.to_double() - camera.fy.to_double() * (z - 0.12) / depth); };
    sensor::Blob blob;
    blob.signature = 1;
    blob.x1 = column(0.05);
    blob.x2 = column(-0.05);
    blob.y1 = row(0.2);
    blob.y2 = row(0);
    return blob;
  }

 private:
  static std::int16_t at(double pixel) { return static_cast<std::int16_t>(pixel); }

  linux::MonotonicClock clock_;
  std::atomic<std::int64_t> began_ = -1;
};

}  // namespace fencepost::guest
