// A wheel encoder on two pins, counted by their interrupts.
#pragma once

#include <cstdint>

#include "hal/mcu/quadrature.hpp"
#include "hal/mcu/rp2/pin.hpp"

namespace fencepost::mcu::rp2 {

class Encoder {
 public:
  /// Both of one bank of 32 pins.
  void start(Pin a, Pin b) {
    a_ = a;
    b_ = b;
    a_.interrupt_at_edges();
    b_.interrupt_at_edges();
    quadrature_.start(a_.high(), b_.high());
  }
  /// The interrupt that all pins share: the flag is cleared first, so a later edge interrupts again.
  void on_interrupt() {
    a_.forget_edges();
    b_.forget_edges();
    const std::uint32_t levels = a_.levels();
    quadrature_.feed((levels & a_.mask()) != 0, (levels & b_.mask()) != 0);
  }
  /// Modulo 2^32.
  [[nodiscard]] std::uint32_t count() const { return quadrature_.count(); }

 private:
  Pin a_;
  Pin b_;
  Quadrature quadrature_;
};

}  // namespace fencepost::mcu::rp2
