// Turns two wheels' values in CAN frames into poses. Independent of the bus.
#pragma once

#include <cstdint>
#include <optional>

#include "drivers/can_wheels/signal.hpp"
#include "drivers/odometry/wheel_pairs.hpp"
#include "hal/bus/can_bus.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::can_wheels {

enum class Quantity : std::uint8_t { kCounts, kVelocities };

struct Mapping {
  Signal left;
  Signal right;
  Quantity quantity = Quantity::kCounts;
  /// Scale and sign. Counts: pm a count, and the bits at which they wrap, which is the signal's size unless the device
  /// says otherwise. Velocities: pm a second a unit, 1 mm/s is 10^9; the bits are not used. Negative: mounted reversed.
  odometry::WheelBase wheels;
  base::Duration silence = base::milliseconds(300);  ///< longest time between frames before the link counts as silent
};

struct Counters {
  std::uint32_t frames = 0;     ///< of our wheels
  std::uint32_t unrelated = 0;  ///< with other ids
  std::uint32_t malformed = 0;  ///< ours, but too short, or faster than the wheel can turn
};

/// Counts are absolute: a lost frame costs nothing. A controller may restart during a silence of 0.2 s or more. Then a
/// count nearer to zero than to the last one is a restart; the distance driven meanwhile is lost. Velocities are
/// integrated by the trapezoidal rule. Over more than half a second of silence no motion is assumed.
class Wheels {
 public:
  explicit Wheels(const Mapping& mapping);

  /// `t`: when the frame arrived.
  std::optional<sensor::OdometrySample> take(const bus::CanFrame& frame, base::Time t);

  /// silent: no frames of either wheel; unready: of one wheel only, or malformed ones.
  [[nodiscard]] sensor::LinkState link(base::Time now) const;
  void forget();
  [[nodiscard]] const Counters& counters() const { return counters_; }

 private:
  struct Wheel {
    std::optional<base::Time> heard;
    std::int64_t speed_pm_s = 0;
    std::int64_t way_pm = 0;
    std::uint32_t count = 0;
  };

  std::optional<std::uint32_t> count_in(const bus::CanFrame& frame, const Signal& signal, std::int64_t scale_pm,
                                        Wheel& wheel, base::Time t);
  [[nodiscard]] bool has_restarted(const Wheel& wheel, std::uint32_t count, base::Time t) const;
  [[nodiscard]] std::optional<std::uint32_t> integrate(std::int64_t value, std::int64_t scale_pm, Wheel& wheel,
                                                       base::Time t) const;
  [[nodiscard]] bool heard_lately(const Wheel& wheel, base::Time now) const;

  Mapping mapping_;
  odometry::WheelPairs pairs_;
  Wheel left_;
  Wheel right_;
  Counters counters_;
};

}  // namespace fencepost::can_wheels
