// STM32F405 boards: Netduino Plus 2, pyboard 1.x, Feather F405. What every board offers: hal/boards/README.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/mcu/cortex_m/systick_clock.hpp"
#include "hal/mcu/reset.hpp"
#include "hal/mcu/stm32f4/encoder.hpp"
#include "hal/mcu/stm32f4/flash.hpp"
#include "hal/mcu/stm32f4/i2c.hpp"
#include "hal/mcu/stm32f4/uart.hpp"

namespace fencepost::board {

inline constexpr std::string_view kTarget = "f405";
inline constexpr int kEncoderBits = 16;

using Clock = mcu::cortex_m::SysTickClock;
using Link = mcu::stm32f4::Uart;
using I2c = mcu::stm32f4::I2c;
using Flash = mcu::stm32f4::Flash;

/// Before anything else here: clocks, timer, watchdog, console.
void start(std::uint32_t console_baud);
/// Before the link is used.
void start_camera(std::uint32_t baud);
void start_base(std::uint32_t baud);
void start_encoders();
void start_i2c();

Clock& clock();
Link& console();  ///< USART2: PA2 sends, PA3 receives
Link& camera();   ///< USART1: PA9 sends, PA10 receives
Link& base();     ///< USART3: PB10 sends, PB11 receives; a wheel base such as a Create
I2c& i2c();       ///< I2C1: PB8 clock, PB9 data; a Pixy2 or NXTCam
Flash& flash();
/// Left wheel: PA6 and PA7. Right wheel: PB6 and PB7. Modulo 2^kEncoderBits.
std::uint32_t left_count();
std::uint32_t right_count();

mcu::ResetReason take_reset_reason();
std::optional<mcu::Panic> take_panic();

void feed_watchdog();
/// Sleeps until something may have happened: a byte, or a millisecond.
void idle();

}  // namespace fencepost::board
