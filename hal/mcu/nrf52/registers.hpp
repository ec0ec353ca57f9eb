// Registers of the nRF52833 that the nRF51822 does not have. Source: nRF52833 Product Specification v1.5, chapters by
// their names; addresses: its memory map. All others are those of hal/mcu/nrf51/registers.hpp: this part has the serial
// line, the I2C master, timer, watchdog, flash controller and pins of the older one as well, at the same addresses,
// where its manual calls UART and TWI deprecated.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"

namespace fencepost::mcu::nrf52 {

inline constexpr std::uint32_t kFlashPage = 4096;  // bytes (Memory)

// Flash controller, NVMC: a cache of instructions, off after a reset.
inline constexpr std::uint32_t kInstructionCache = nrf51::kFlash + 0x540;
inline constexpr std::uint32_t kCacheOn = 1U << 0;

// Timer.
inline constexpr std::uint32_t kTimerStop = nrf51::kTimer + 0x004;
inline constexpr std::uint32_t kTimerClear = nrf51::kTimer + 0x00C;
inline constexpr std::uint32_t kTimerInterruptsOff = nrf51::kTimer + 0x308;

// Serial line and I2C master: while they are on, their pins must not be chosen (UART, TWI: registers PSEL).
inline constexpr std::uint32_t kUartInterruptsOff = nrf51::kUart + 0x308;
inline constexpr std::uint32_t kUartOff = 0;

// What the part reads of its flash before it starts (UICR): the pin that resets it, in two words that have to agree.
inline constexpr std::uint32_t kResetPin0 = 0x1000'1200;
inline constexpr std::uint32_t kResetPin1 = 0x1000'1204;
inline constexpr std::uint32_t kErased = 0xFFFF'FFFF;

}  // namespace fencepost::mcu::nrf52
