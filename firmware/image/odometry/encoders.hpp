// FENCEPOST_ODOMETRY=encoders: two quadrature encoders on the board's pins.
#pragma once

#include <optional>

#include "drivers/odometry/differential_drive.hpp"
#include "firmware/config/wheels.hpp"
#include "firmware/console/counters.hpp"
#include "hal/sensor/sources.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

/// A pose every 20 ms from the counts as they stand. Encoders cannot be seen to be missing: a wheel that never turns
/// looks the same. So the link is empty until the first count, then ok.
class Odometry {
 public:
  explicit Odometry(const console::Counters& /*counters*/) {}
  static void start() { board::start_encoders(); }

  base::Result<sensor::OdometrySample> poll(base::Time now) {
    if (last_ && now - *last_ < kInterval) return base::Error::kNotReady;
    last_ = now;
    const std::uint32_t left = board::left_count();
    const std::uint32_t right = board::right_count();
    moved_ = moved_ || left != 0 || right != 0;
    return drive_.take(left, right, now);
  }
  [[nodiscard]] sensor::LinkState link() const { return moved_ ? sensor::LinkState::kOk : sensor::LinkState::kEmpty; }

 private:
  static constexpr base::Duration kInterval = base::milliseconds(20);

  odometry::DifferentialDrive drive_{config::kWheels};
  std::optional<base::Time> last_;
  bool moved_ = false;
};
static_assert(sensor::OdometrySource<Odometry>);

}  // namespace fencepost::image
