// Two wheel controllers on a CAN bus.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/base/units.hpp"
#include "hal/bus/can_bus.hpp"

namespace fencepost::emulate {

/// Each sends its frame every 20 ms, the right one 7 ms after the left.
class CanWheels {
 public:
  enum class Kind : std::uint8_t {
    kCanopen,   ///< TPDO1 of nodes 5 and 6: status word and i32 position
    kTalonSrx,  ///< status 2 of devices 3 and 4: 24-bit position and i16 velocity per 100 ms, big-endian
  };
  static constexpr base::Duration kPeriod = base::milliseconds(20);
  static constexpr base::Duration kPhase = base::milliseconds(7);
  static constexpr base::Duration kBoot = base::milliseconds(400);

  CanWheels(Kind kind, base::Time power_on) : kind_(kind) { restart(power_on); }

  /// Counts since power-on of the world, and per 100 ms.
  void turn(std::int32_t left, std::int32_t right, std::int16_t left_rate, std::int16_t right_rate);
  /// The controllers count from zero again.
  void restart(base::Time now);
  /// The frames that are due.
  std::vector<bus::CanFrame> frames(base::Time now);
  /// When the next frame is due.
  [[nodiscard]] base::Time next() const {
    return wheels_[0].next < wheels_[1].next ? wheels_[0].next : wheels_[1].next;
  }

 private:
  struct Wheel {
    std::int32_t count = 0;
    std::int32_t zero = 0;
    std::int16_t rate = 0;
    base::Time next;
  };
  [[nodiscard]] bus::CanFrame frame(const Wheel& wheel, std::uint32_t index) const;

  Kind kind_;
  Wheel wheels_[2];
};

}  // namespace fencepost::emulate
