// A serial line: 8N1, both ways through rings that its interrupt fills and empties.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/rings.hpp"
#include "hal/mcu/rp2/pin.hpp"

namespace fencepost::mcu::rp2 {

/// One line, by the part and the board's wiring.
struct UartWiring {
  std::uint32_t base = 0;
  std::uint32_t reset = 0;
  std::uint32_t interrupt = 0;
  Pin transmit;
  Pin receive;
};

class Uart {
 public:
  /// Before anything else here; again, for another device at another speed. `clock_hz`: of the peripherals. The wiring
  /// is not a constructor's: an object that begins with zeros costs no flash.
  void start(const UartWiring& wiring, std::uint32_t clock_hz, std::uint32_t baud);

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return rings_.read(in); }
  /// Before the start, bytes are discarded: a board may have no such line.
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);
  /// Bytes that write() would take now.
  [[nodiscard]] std::size_t room() const { return rings_.room(); }

  /// The line's interrupt.
  void on_interrupt();

  [[nodiscard]] bool waiting() const { return rings_.waiting(); }

 private:
  void receive();
  void send();

  std::uint32_t base_ = 0;
  Rings<1024, 2048> rings_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::mcu::rp2
