// Odometry of a robot with two driven motors on an NXT brick.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/nxt/conversation.hpp"
#include "drivers/odometry/wheel_pairs.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::nxt {

/// 360 counts a revolution of the motor's axle; the wheel of the NXT 1.0 set, 56 mm, on the track of its first robot.
/// Measure yours. A motor that is mounted the other way round has a negative count.
inline constexpr odometry::WheelBase kSetWheels = odometry::make_wheel_base({56.0, 360.0}, 112.0, 32);

struct TachoOptions {
  std::uint8_t left_port = 1;  ///< 0 to 2: A to C
  std::uint8_t right_port = 2;
  odometry::WheelBase wheels = kSetWheels;
  base::Duration period = base::milliseconds(20);  ///< of pairs; a slow link takes longer
};

/// The motors are read one after the other; see WheelPairs for what the time of a sample is.
class TachoOdometry {
 public:
  TachoOdometry(Conversation& conversation, const TachoOptions& options)
      : conversation_(conversation), options_(options), pairs_(options.wheels) {}

  base::Result<sensor::OdometrySample> poll(base::Time now);
  /// unready: the brick answers with errors (no such motor port).
  [[nodiscard]] sensor::LinkState link() const;

 private:
  void ask(base::Time now);
  std::optional<sensor::OdometrySample> take(std::uint32_t count, base::Time t);
  void start_anew();

  Conversation& conversation_;
  TachoOptions options_;
  odometry::WheelPairs pairs_;
  Exchange exchange_;
  bool right_next_ = false;
  bool refused_ = false;
  std::uint32_t session_ = 0;
  std::optional<base::Time> next_;
};

static_assert(sensor::OdometrySource<TachoOdometry>);

}  // namespace fencepost::nxt
