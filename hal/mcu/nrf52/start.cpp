#include "hal/mcu/nrf52/start.hpp"

#include <array>

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf51/flash.hpp"
#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/nrf52/uart.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf52 {

void start_part() {
  constexpr std::uint32_t kAll = 0xFFFF'FFFF;
  reg(kTimerStop) = nrf51::kTrigger;
  reg(kTimerClear) = nrf51::kTrigger;
  reg(kTimerInterruptsOff) = kAll;
  reg(kUartInterruptsOff) = kAll;
  reg(nrf51::kUartEnable) = kUartOff;
  reg(nrf51::kTwi0 + nrf51::kTwiInterruptsOff) = kAll;
  reg(nrf51::kTwi0 + nrf51::kTwiEnable) = 0;
  stop_line();
  reg(kEdgeInterruptsOff) = kAll;
  reg(kInstructionCache) = kCacheOn;
}

// A part that cannot write them runs without its button.
void connect_reset_pin(std::uint32_t number) {
  static_assert(kResetPin1 == kResetPin0 + bus::kFlashWord);
  bool connected = true;
  for (const std::uint32_t word : {reg(kResetPin0), reg(kResetPin1)}) {
    if (word != kErased && word != number) return;
    connected = connected && word == number;
  }
  if (connected) return;
  std::array<std::uint8_t, 2 * bus::kFlashWord> words{};
  words[0] = words[bus::kFlashWord] = static_cast<std::uint8_t>(number);
  if (nrf51::program_words(kResetPin0, words)) cortex_m::reset();
}

}  // namespace fencepost::mcu::nrf52
