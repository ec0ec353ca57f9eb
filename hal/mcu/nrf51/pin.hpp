// A pin, and what it is set up as.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {

struct Pin {
  std::uint32_t number = 0;  ///< P0.00 to P0.31

  void make_output() const { configure(kPinOutput | kPinInputOff); }
  /// Pulled up, so that a line with nothing on it is quiet.
  void make_input() const { configure(kPinPullUp); }
  /// As the wires of an I2C bus have to be (28.4); the board's own resistors pull up, this helps where none are.
  void make_two_wire() const { configure(kPinPullUp | kPinDrivesLowOnly); }
  /// The same, but driven by drive().
  void make_two_wire_by_hand() const { configure(kPinOutput | kPinPullUp | kPinDrivesLowOnly); }
  void drive(bool high) const { reg(high ? kPinsSet : kPinsClear) = 1U << number; }
  /// Of a wire that is driven by hand: pulled down or left alone.
  void pull_down(bool down) const { drive(!down); }
  [[nodiscard]] bool high() const { return (reg(kPinsIn) >> number & 1U) != 0; }

 private:
  void configure(std::uint32_t bits) const { reg(kPinsConfig + 4 * number) = bits; }
};

}  // namespace fencepost::mcu::nrf51
