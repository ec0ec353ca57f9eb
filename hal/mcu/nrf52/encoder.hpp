// A wheel encoder on two pins, counted by interrupts at their edges.
#pragma once

#include <cstdint>

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf52/pin.hpp"
#include "hal/mcu/nrf52/registers.hpp"
#include "hal/mcu/quadrature.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf52 {

/// Takes two of the part's eight channels for edges.
class Encoder {
 public:
  /// `channel`: the first of its two.
  void start(Pin a, Pin b, std::uint32_t channel) {
    a_ = a;
    b_ = b;
    channel_ = channel;
    watch(a_, channel_);
    watch(b_, channel_ + 1);
    quadrature_.start(a_.high(), b_.high());
    cortex_m::enable_interrupt(nrf51::interrupt_of(kEdges));
  }
  /// The interrupt that all channels share: the events are cleared first, so a later edge interrupts again.
  void on_interrupt() {
    reg(kEdgeSeen + 4 * channel_) = 0;
    reg(kEdgeSeen + 4 * (channel_ + 1)) = 0;
    quadrature_.feed(a_.high(), b_.high());
  }
  /// Modulo 2^32.
  [[nodiscard]] std::uint32_t count() const { return quadrature_.count(); }

 private:
  // The channel is set up before its interrupt is let through: that may look like an edge (GPIOTE, chapter events).
  static void watch(Pin pin, std::uint32_t channel) {
    pin.make_input();
    reg(kEdgeChannel + 4 * channel) = kEdgeEvents | pin.number << kEdgePinPlace | kEdgeBoth;
    reg(kEdgeSeen + 4 * channel) = 0;
    reg(kEdgeInterrupts) = 1U << channel;
  }

  Pin a_;
  Pin b_;
  std::uint32_t channel_ = 0;
  Quadrature quadrature_;
};

}  // namespace fencepost::mcu::nrf52
