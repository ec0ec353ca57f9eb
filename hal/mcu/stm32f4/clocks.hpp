// The clock tree: 168 MHz out of the board's crystal, or out of the part's own oscillator.
#pragma once

#include <array>
#include <cstdint>

#include "hal/mcu/register.hpp"

namespace fencepost::mcu::stm32f4 {

/// Hz, as they came to be.
struct Clocks {
  std::uint32_t core = 0;
  std::uint32_t apb1 = 0;   ///< USART2, USART3, UART4, I2C1
  std::uint32_t apb2 = 0;   ///< USART1, USART6
  std::uint32_t timer = 0;  ///< timers 2 to 5
};

/// MHz of those that boards of a preset are sold with; a zero is none.
using Crystals = std::array<std::uint8_t, 2>;

/// From whatever state a boot loader or a debugger has left: no interrupt of its peripherals, no clock of its own. 168,
/// 42 and 84 MHz by the PLL. The crystal, one of `crystals`, is found by measurement: a preset on another board must
/// not overclock it. Without one of these the PLL runs on the internal oscillator. That is within 1 % at room
/// temperature and 4 % from -10 to 85 degrees (datasheet 5.3.9); a serial line bears 3. Where the PLL does not lock the
/// part runs at 16 MHz, with correct baud rates.
Clocks start_clocks(Crystals crystals);

/// `bits` of one of the clock control's enable registers. The peripheral answers two cycles later (errata ES0182
/// 2.1.13): reading the register back takes as long.
inline void enable_clock(std::uint32_t enable_register, std::uint32_t bits) {
  set_bits(enable_register, bits);
  [[maybe_unused]] const std::uint32_t waited = reg(enable_register);
}

}  // namespace fencepost::mcu::stm32f4
