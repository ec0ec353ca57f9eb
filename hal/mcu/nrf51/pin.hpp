// A pin, and what it is set up as.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {

/// `kPorts`: how many the part has. P0.00 to P0.31 are 0 to 31; of a second port P1.00 is 32, as in registers that name
/// a pin.
template <std::uint32_t kPorts>
struct PinOf {
  std::uint32_t number = 0;

  void make_output() const { configure(kPinOutput | kPinInputOff); }
  /// Pulled up, so that a line with nothing on it is quiet.
  void make_input() const { configure(kPinPullUp); }
  /// As the wires of an I2C bus have to be (28.4); the board's own resistors pull up, this helps where none are.
  void make_two_wire() const { configure(kPinPullUp | kPinDrivesLowOnly); }
  /// The same, but driven by drive().
  void make_two_wire_by_hand() const { configure(kPinOutput | kPinPullUp | kPinDrivesLowOnly); }
  void drive(bool high) const { reg(port() + (high ? kPinsSet : kPinsClear)) = 1U << in_port(); }
  /// Of a wire that is driven by hand: pulled down or left alone.
  void pull_down(bool down) const { drive(!down); }
  [[nodiscard]] bool high() const { return (reg(port() + kPinsIn) >> in_port() & 1U) != 0; }

 private:
  /// From the first port's registers to its own.
  [[nodiscard]] std::uint32_t port() const { return kPorts == 1 ? 0 : kPinsStride * (number / 32); }
  [[nodiscard]] std::uint32_t in_port() const { return kPorts == 1 ? number : number % 32; }
  void configure(std::uint32_t bits) const { reg(port() + kPinsConfig + 4 * in_port()) = bits; }
};

using Pin = PinOf<1>;

}  // namespace fencepost::mcu::nrf51
