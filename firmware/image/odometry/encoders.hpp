// The odometry `encoders`: two quadrature encoders on the board's pins, at wheels as the settings `wheel.*` have them.
#pragma once

#include <array>
#include <optional>

#include "drivers/odometry/differential_drive.hpp"
#include "firmware/image/opening.hpp"
#include "firmware/image/unsaid.hpp"
#include "hal/sensor/sources.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

/// A pose every 20 ms from the present counts. Missing encoders look like a wheel that never turns. So the link is
/// empty until the first count, then ok.
class Encoders {
 public:
  static constexpr std::array kOdometries = {config::OdometryId::kEncoders};
  explicit Encoders(const Opening& opening) : drive_(opening.devices.wheels(board::kEncoderBits)) {}
  static void start(const Opening& /*opening*/) { board::start_encoders(); }

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

  odometry::DifferentialDrive drive_;
  std::optional<base::Time> last_;
  bool moved_ = false;
};
static_assert(sensor::OdometrySource<Encoders>);

}  // namespace fencepost::image
