// Pins of boards with an RP2040 or an RP2350, and their uses.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/boards/pico/wiring.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "tests/hal/boards/pin_table.hpp"

namespace fencepost::test {

inline std::string name(mcu::rp2::Pin pin) { return "GP" + std::to_string(pin.number); }

inline void add_line(std::vector<PinUse>& uses, const std::string& what, const mcu::rp2::UartWiring& line) {
  const std::string of = line.base == mcu::rp2::kUart0 ? "UART0" : "UART1";
  uses.push_back({what + " sends", name(line.transmit), of + "_TX", mcu::rp2::kFunctionUart});
  uses.push_back({what + " receives", name(line.receive), of + "_RX", mcu::rp2::kFunctionUart});
}

// A motor of the robot's own has no pin on the header; the driver of another one is beside the board.
inline void add_motor(std::vector<PinUse>& uses, const std::string& side, const mcu::rp2::MotorWiring& motor) {
  const std::string meant = motor.direction ? side + " motor" : "";
  const std::uint32_t n = motor.power.number;
  const std::uint32_t slice = n < 32 ? n / 2 % 8 : 8 + n / 2 % 4;
  const std::string signal = "PWM" + std::to_string(slice) + (n % 2 == 0 ? "_A" : "_B");
  uses.push_back({side + " motor", name(motor.power), signal, mcu::rp2::kFunctionPwm, meant});
  if (motor.direction) uses.push_back({side + " direction", name(*motor.direction), {}, 0, meant});
}

inline std::vector<PinUse> uses_of(const board::Wiring& wiring) {
  std::vector<PinUse> uses;
  if (wiring.console) add_line(uses, "console", *wiring.console);
  add_line(uses, "camera", wiring.camera);
  const std::string bus = wiring.i2c.base == mcu::rp2::kI2c0 ? "I2C0" : "I2C1";
  uses.push_back({"bus data", name(wiring.i2c.data), bus + "_SDA", mcu::rp2::kFunctionI2c});
  uses.push_back({"bus clock", name(wiring.i2c.clock), bus + "_SCL", mcu::rp2::kFunctionI2c});
  uses.push_back({"left a", name(wiring.left.a)});
  uses.push_back({"left b", name(wiring.left.b)});
  uses.push_back({"right a", name(wiring.right.a)});
  uses.push_back({"right b", name(wiring.right.b)});
  if (wiring.light) uses.push_back({"light", name(*wiring.light), {}, 0, "led"});
  uses.push_back({"button", name(wiring.button), {}, 0, wiring.target.starts_with("xrp") ? "button" : ""});
  uses.push_back({"stop", name(wiring.stop)});
  add_motor(uses, "left", wiring.left_motor);
  add_motor(uses, "right", wiring.right_motor);
  return uses;
}

}  // namespace fencepost::test
