// A pin, and what it is set up as.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2040/registers.hpp"

namespace fencepost::mcu::rp2040 {

struct Pin {
  std::uint32_t number = 0;

  /// The pin becomes that of a peripheral: functions by 2.19.2. Pulled up, so that a line with nothing on it is quiet.
  void connect(std::uint32_t function, std::uint32_t pad = kPadInputPulledUp) const {
    reg(kPad + 4 * number) = pad;
    reg(kPinControl + 8 * number) = function;
  }
  /// Low; pulled down where nobody drives it.
  void make_output() const {
    drive(false);
    reg(kSioDriveSet) = mask();
    connect(kFunctionSoftware, kPadInputPulledDown);
  }
  void drive(bool high) const { reg(high ? kSioOutSet : kSioOutClear) = mask(); }
  /// Open drain, by pull_down(); released at first.
  void take_wire() const {
    pull_down(false);
    drive(false);
    connect(kFunctionSoftware);
  }
  /// Or left alone.
  void pull_down(bool down) const { reg(down ? kSioDriveSet : kSioDriveClear) = mask(); }
  /// Of all pins, a bit each.
  [[nodiscard]] static std::uint32_t levels() { return reg(kSioIn); }
  [[nodiscard]] bool high() const { return (levels() & mask()) != 0; }
  [[nodiscard]] std::uint32_t mask() const { return 1U << number; }

  void interrupt_at_edges() const {
    connect(kFunctionSoftware);
    forget_edges();
    raise_bits(kPinInterruptEnable + word(), kPinEdges << shift());
  }
  /// In the interrupt.
  void forget_edges() const { reg(kPinInterrupts + word()) = kPinEdges << shift(); }

 private:
  [[nodiscard]] std::uint32_t word() const { return 4 * (number / 8); }
  [[nodiscard]] std::uint32_t shift() const { return 4 * (number % 8); }
};

}  // namespace fencepost::mcu::rp2040
