// A timer counts the edges of a wheel encoder's two channels, four a period, up or down.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/pin.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

class Encoder {
 public:
  /// `timer_enable`: its bit in kRccApb1Enable. Timers 3 and 4 have 16 bits and their pins on function 2.
  constexpr Encoder(std::uint32_t timer, std::uint32_t timer_enable, Pin a, Pin b)
      : timer_(timer), timer_enable_(timer_enable), a_(a), b_(b) {}

  void start() const {
    set_bits(kRccApb1Enable, timer_enable_);
    a_.connect(2);
    b_.connect(2);
    reg(timer_ + kTimerInputs) = kInputsFiltered;
    reg(timer_ + kTimerPolarity) = 0;
    reg(timer_ + kTimerReload) = 0xFFFF;
    reg(timer_ + kTimerSlaveMode) = kEncoderBothEdges;
    reg(timer_ + kTimerControl) = kTimerEnable;
  }
  /// Modulo 2^16.
  [[nodiscard]] std::uint32_t count() const { return reg(timer_ + kTimerCount) & 0xFFFFU; }

 private:
  std::uint32_t timer_;
  std::uint32_t timer_enable_;
  Pin a_;
  Pin b_;
};

}  // namespace fencepost::mcu::stm32f4
