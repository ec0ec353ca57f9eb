// A serial line of a board.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::port {

/// Fill in: set up pins, clock and 8N1 at `baud` in the constructor. The receive interrupt (or DMA) puts bytes into a
/// ring of fixed size; the transmit interrupt takes them from another.
class Uart {
 public:
  explicit Uart(std::uint32_t baud) : baud_(baud) {}

  /// Fill in: move what the ring holds, at most in.size(). kBadInput, once, after an overrun or framing error.
  /// A line on the board is never gone; one over USB is, while nobody has it open.
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (in.empty()) return std::size_t{0};
    return base::Error::kNotReady;
  }
  /// Fill in: put what fits into the ring and enable the transmit interrupt. Never wait for the line.
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (out.empty()) return std::size_t{0};
    return base::Error::kFull;
  }
  [[nodiscard]] std::uint32_t baud() const { return baud_; }

 private:
  std::uint32_t baud_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::port
