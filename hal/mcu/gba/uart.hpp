// The link port as a serial line: 8N1, 3.3 V. SO sends, SI receives; SD goes low while bytes are welcome.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/rings.hpp"

namespace fencepost::mcu::gba {

class Uart {
 public:
  /// Called once, before anything else here. The part knows 9600, 38400, 57600 and 115200 baud; another is taken for
  /// the last.
  void start(std::uint32_t baud);

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return rings_.read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) { return rings_.write(out); }

  /// From the serial interrupt, and from the clock's. Only GBATEK describes what raises the former. A tick comes before
  /// four bytes can (11520 bytes a second, 4096 ticks). Empties and fills the part's buffers.
  void serve();

  [[nodiscard]] bool waiting() const { return rings_.waiting(); }

 private:
  Rings<1024, 2048> rings_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::mcu::gba
