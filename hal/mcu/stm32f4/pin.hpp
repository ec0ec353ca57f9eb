// A pin, and what it is set up as.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

struct Pin {
  char port = 'A';
  std::uint32_t number = 0;

  [[nodiscard]] constexpr bool operator==(const Pin&) const = default;
  [[nodiscard]] std::uint32_t address() const { return kPortA + kPortStride * static_cast<std::uint32_t>(port - 'A'); }
  /// The pin becomes that of a peripheral: alternate functions by table 9 of the datasheet. Pulled up, so that a line
  /// with nothing on it is quiet.
  void connect(std::uint32_t function) const {
    turn_on();
    const std::uint32_t shift = 4 * (number % 8);
    change_bits(address() + kPortFunction + 4 * (number / 8), 0xFU << shift, function << shift);
    change_bits(address() + kPortPull, 0x3U << (2 * number), kPullUp << (2 * number));
    change_bits(address() + kPortMode, 0x3U << (2 * number), kModeAlternate << (2 * number));
  }
  /// The same with open drain, for a bus.
  void connect_open(std::uint32_t function) const {
    connect(function);
    set_bits(address() + kPortOpen, 1U << number);
  }
  /// Driven by hand, open drain; released at first.
  void make_open_output() const {
    turn_on();
    drive(true);
    set_bits(address() + kPortOpen, 1U << number);
    change_bits(address() + kPortPull, 0x3U << (2 * number), kPullUp << (2 * number));
    change_bits(address() + kPortMode, 0x3U << (2 * number), kModeOutput << (2 * number));
  }
  [[nodiscard]] bool high() const { return (reg(address() + kPortInput) & (1U << number)) != 0; }
  /// Driven by hand, at first as said: its level is there before the pin drives.
  void make_output(bool high) const {
    turn_on();
    drive(high);
    change_bits(address() + kPortMode, 0x3U << (2 * number), kModeOutput << (2 * number));
  }
  void drive(bool high) const { reg(address() + kPortSet) = 1U << (number + (high ? 0U : 16U)); }
  /// Open drain: pulled down or released.
  void pull_down(bool down) const { drive(!down); }

 private:
  void turn_on() const { enable_clock(kRccAhb1Enable, 1U << static_cast<std::uint32_t>(port - 'A')); }
};

}  // namespace fencepost::mcu::stm32f4
