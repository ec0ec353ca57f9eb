// The clock tree: 168 MHz out of the part's own oscillator.
#pragma once

#include <cstdint>

namespace fencepost::mcu::stm32f4 {

/// Hz, as they came to be.
struct Clocks {
  std::uint32_t core = 0;
  std::uint32_t apb1 = 0;  ///< USART2, USART3
  std::uint32_t apb2 = 0;  ///< USART1
};

/// 168, 42 and 84 MHz by the PLL from the internal 16 MHz. Not from a crystal: boards of this part carry 8, 12 or
/// 25 MHz, and one image serves all; the internal oscillator is within 1 % at room temperature (datasheet 5.3.9), a
/// serial line bears 2. Where the PLL does not lock the part runs at 16 MHz, with correct baud rates.
Clocks start_clocks();

}  // namespace fencepost::mcu::stm32f4
