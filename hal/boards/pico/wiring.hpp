// The names and pins in which boards with an RP2040 differ. Each board's are in its pins.hpp.
#pragma once

#include <optional>
#include <string_view>

#include "hal/bus/pin_names.hpp"
#include "hal/mcu/rp2/i2c.hpp"
#include "hal/mcu/rp2/motors.hpp"
#include "hal/mcu/rp2/pin.hpp"
#include "hal/mcu/rp2/uart.hpp"

namespace fencepost::board {

struct EncoderPins {
  mcu::rp2::Pin a;
  mcu::rp2::Pin b;
};

struct Wiring {
  std::string_view target;                      ///< in the header of each log
  std::optional<mcu::rp2::UartWiring> console;  ///< beside USB
  mcu::rp2::UartWiring camera;                  ///< or a wheel base
  mcu::rp2::I2cWiring i2c;
  EncoderPins left;
  EncoderPins right;
  std::optional<mcu::rp2::Pin> light;  ///< an LED, on while high
  mcu::rp2::Pin button;                ///< to ground, pulled up by the part
  mcu::rp2::Pin stop;                  ///< low stops the motors; low from reset on by the part itself
  mcu::rp2::MotorWiring left_motor;
  mcu::rp2::MotorWiring right_motor;
  bus::PinNames names;  ///< of the pins above, as `status` says them
};

}  // namespace fencepost::board
