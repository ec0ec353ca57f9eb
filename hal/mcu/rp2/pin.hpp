// A pin, and what it is set up as.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {

struct Pin {
  std::uint32_t number = 0;

  /// The pin becomes that of a peripheral: functions by 2.19.2. Pulled up, so that a line with nothing on it is quiet.
  void connect(std::uint32_t function, std::uint32_t pad = kPadInputPulledUp) const {
    reg(kPinControl + 8 * number) = function;
    reg(kPad + 4 * number) = pad;  // then: an RP2350's pad is isolated until this
  }
  /// Low; pulled down where nobody drives it: without its input, since an RP2350's holds 2.2 V against its pull-down
  /// (erratum RP2350-E9).
  void make_output() const {
    drive(false);
    pull_down(true);
    connect(kFunctionSoftware, kPadOutput);
  }
  void drive(bool high) const { reg((high ? kSioOutSet : kSioOutClear) + bank()) = mask(); }
  /// Open drain, by pull_down(); released at first.
  void take_wire() const {
    pull_down(false);
    drive(false);
    connect(kFunctionSoftware);
  }
  /// Or left alone.
  void pull_down(bool down) const { reg((down ? kSioDriveSet : kSioDriveClear) + bank()) = mask(); }
  /// Of all pins of its bank, a bit each.
  [[nodiscard]] std::uint32_t levels() const { return reg(kSioIn + bank()); }
  [[nodiscard]] bool high() const { return (levels() & mask()) != 0; }
  [[nodiscard]] std::uint32_t mask() const { return 1U << number % 32; }

  void interrupt_at_edges() const {
    connect(kFunctionSoftware);
    forget_edges();
    raise_bits(kPinInterruptEnable + word(), kPinEdges << shift());
  }
  /// In the interrupt.
  void forget_edges() const { reg(kPinInterrupts + word()) = kPinEdges << shift(); }

 private:
  /// Where its bank's registers are behind the first's.
  [[nodiscard]] std::uint32_t bank() const { return kPins > 32 ? 4 * (number / 32) : 0; }
  [[nodiscard]] std::uint32_t word() const { return 4 * (number / 8); }
  [[nodiscard]] std::uint32_t shift() const { return 4 * (number % 8); }
};

}  // namespace fencepost::mcu::rp2
