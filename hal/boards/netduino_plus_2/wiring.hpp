// The names, crystals and pins in which boards with an STM32F405 differ. Each board's are in its pins.hpp.
#pragma once

#include <optional>
#include <string_view>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/encoder.hpp"
#include "hal/mcu/stm32f4/pin.hpp"
#include "hal/mcu/stm32f4/uart.hpp"

namespace fencepost::board {

struct Wiring {
  std::string_view target;  ///< in the header of each log
  mcu::stm32f4::Crystals crystals;
  mcu::stm32f4::UartWiring console;
  mcu::stm32f4::UartWiring camera;
  mcu::stm32f4::UartWiring base;  ///< may share pins with an encoder: a robot has one odometry
  mcu::stm32f4::Pin i2c_clock;    ///< of I2C1
  mcu::stm32f4::Pin i2c_data;
  mcu::stm32f4::EncoderWiring left;
  mcu::stm32f4::EncoderWiring right;
  mcu::stm32f4::Pin light;                 ///< an LED, on while high
  std::optional<mcu::stm32f4::Pin> power;  ///< high for the power of the header's devices
  mcu::stm32f4::Pin stop;                  ///< low stops the motors
  bus::PinNames names;                     ///< of the pins above, as `status` says them
};

}  // namespace fencepost::board
