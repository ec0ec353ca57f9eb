// Two motors at an H-bridge: ahead by some part of their power, or without current. Each has an input of power and one
// of direction (phase and enable). Where it has one for each direction (IN and IN), the second stays low.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/pin.hpp"

namespace fencepost::mcu::rp2 {

struct MotorWiring {
  Pin power;                     ///< high: the bridge drives
  std::optional<Pin> direction;  ///< none: wired to a level beside the board
  bool ahead = false;            ///< its level when the robot goes ahead
};

/// Every stop takes the pins from the modulator and drives them low: that works whatever the modulator does. In a reset
/// they are inputs that the part pulls low.
class Motors {
 public:
  constexpr Motors(const MotorWiring& left, const MotorWiring& right) : left_(left), right_(right) {}

  /// Of the core's clock, Hz. They stand.
  void start(std::uint32_t core_hz) {
    bring_up(kResetPwm);
    started_ = true;
    stop();
    for (const MotorWiring* motor : {&left_, &right_}) {
      motor->power.pull_down(true);
      const std::uint32_t slice = slice_of(motor->power);
      reg(slice + kPwmDivider) = core_hz / kTicksPerSecond << 4U;
      reg(slice + kPwmWrap) = kPeriod - 1;
      reg(slice + kPwmControl) = kPwmEnable;
      if (!motor->direction) continue;
      motor->direction->pull_down(true);
      motor->direction->drive(motor->ahead);
      motor->direction->connect(kFunctionSoftware, kPadOutput);
    }
  }

  /// 0 to 90; 0 stops.
  void ahead(std::int32_t percent) {
    if (percent == power_) return;
    power_ = percent;
    if (percent == 0) return stop();
    for (const MotorWiring* motor : {&left_, &right_}) {
      const std::uint32_t level = static_cast<std::uint32_t>(percent) * (kPeriod / 100);
      reg(slice_of(motor->power) + kPwmLevels) = level | level << 16U;
      motor->power.connect(kFunctionPwm, kPadOutput);
    }
  }

  /// Before the start it leaves pins alone that may be in reset.
  void stop() {
    power_ = 0;
    if (!started_) return;
    for (const MotorWiring* motor : {&left_, &right_}) {
      motor->power.drive(false);
      motor->power.connect(kFunctionSoftware, kPadOutput);
    }
  }

 private:
  static constexpr std::uint32_t kTicksPerSecond = 1'000'000;
  /// 50 Hz, as the XRP's own library has it: slow gear motors turn at little power.
  static constexpr std::uint32_t kPeriod = 20'000;

  // 4.5.2; of an RP2350's pins from 32 on 12.5.1.
  static constexpr std::uint32_t slice_of(Pin pin) {
    return kPwm + kPwmSlice * (pin.number < 32 ? pin.number / 2 % 8 : 8 + pin.number / 2 % 4);
  }

  MotorWiring left_;
  MotorWiring right_;
  std::int32_t power_ = 0;
  bool started_ = false;
};

}  // namespace fencepost::mcu::rp2
