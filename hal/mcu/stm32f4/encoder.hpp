// A timer counts the edges of a wheel encoder's two channels, four a period, up or down.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/pin.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// Timers 3, 4 and 5 have their pins on this function.
inline constexpr std::uint32_t kEncoderFunction = 2;

struct EncoderWiring {
  std::uint32_t timer = 0;
  std::uint32_t enable_bit = 0;  ///< in kRccApb1Enable
  Pin a;                         ///< its channel 1
  Pin b;                         ///< channel 2
};

class Encoder {
 public:
  constexpr explicit Encoder(const EncoderWiring& wiring) : wiring_(wiring), timer_(wiring.timer) {}

  void start() const {
    enable_clock(kRccApb1Enable, wiring_.enable_bit);
    wiring_.a.connect(kEncoderFunction);
    wiring_.b.connect(kEncoderFunction);
    reg(timer_ + kTimerInputs) = kInputsFiltered;
    reg(timer_ + kTimerPolarity) = 0;
    reg(timer_ + kTimerReload) = 0xFFFF;
    reg(timer_ + kTimerSlaveMode) = kEncoderBothEdges;
    reg(timer_ + kTimerControl) = kTimerEnable;
  }
  /// Modulo 2^16.
  [[nodiscard]] std::uint32_t count() const { return reg(timer_ + kTimerCount) & 0xFFFFU; }

 private:
  EncoderWiring wiring_;
  std::uint32_t timer_;
};

}  // namespace fencepost::mcu::stm32f4
