// Wheel encoders in software: two channels, a quarter of a period apart, counted at each of their edges.
#pragma once

#include <array>
#include <cstdint>

namespace fencepost::mcu {

/// Four counts a period, up when channel A leads. Fed with the levels of both channels at each edge of one. Where an
/// edge was missed both have changed: two counts, in the direction of the last one.
class Quadrature {
 public:
  /// Sets the present levels without counting.
  constexpr void start(bool a, bool b) { state_ = state(a, b); }

  constexpr void feed(bool a, bool b) {
    const std::uint32_t next = state(a, b);
    const std::uint32_t turned = (next - state_) & 3U;
    state_ = next;
    if (turned == 0) return;
    if (turned == 2) {
      count_ = count_ + 2 * direction_;
      return;
    }
    direction_ = turned == 1 ? 1U : ~0U;
    count_ = count_ + direction_;
  }

  /// Modulo 2^32.
  [[nodiscard]] std::uint32_t count() const { return count_; }

 private:
  // Quarters of a period: 00, 10, 11, 01 as A leads.
  static constexpr std::uint32_t state(bool a, bool b) {
    constexpr std::array<std::uint8_t, 4> kQuarters = {0, 1, 3, 2};
    return kQuarters[(a ? 1U : 0U) | (b ? 2U : 0U)];
  }

  volatile std::uint32_t count_ = 0;  // the interrupt feeds, the loop reads
  std::uint32_t state_ = 0;
  std::uint32_t direction_ = 1;
};

}  // namespace fencepost::mcu
