// A serial line: 8N1, both ways through rings that its interrupt fills and empties.
#pragma once

#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/rings.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/pin.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

/// One of the part's serial lines.
struct UartPart {
  std::uint32_t base = 0;
  std::uint32_t enable_register = 0;  ///< in the clock control
  std::uint32_t enable_bit = 0;
  std::uint32_t interrupt = 0;
  std::uint32_t function = 0;  ///< of its pins (datasheet table 9)

  [[nodiscard]] constexpr std::uint32_t hz(const Clocks& clocks) const {
    return enable_register == kRccApb1Enable ? clocks.apb1 : clocks.apb2;
  }
};
inline constexpr UartPart kUsart1Part = {kUsart1, kRccApb2Enable, kUsart1Clock, kInterruptUsart1, 7};
inline constexpr UartPart kUsart2Part = {kUsart2, kRccApb1Enable, kUsart2Clock, kInterruptUsart2, 7};
inline constexpr UartPart kUsart3Part = {kUsart3, kRccApb1Enable, kUsart3Clock, kInterruptUsart3, 7};
inline constexpr UartPart kUart4Part = {kUart4, kRccApb1Enable, kUart4Clock, kInterruptUart4, 8};
inline constexpr UartPart kUsart6Part = {kUsart6, kRccApb2Enable, kUsart6Clock, kInterruptUsart6, 8};

/// And the board's pins for it.
struct UartWiring {
  UartPart part;
  Pin transmit;
  Pin receive;
};

class Uart {
 public:
  /// Before anything else here; again, for another device at another speed. The wiring is not a constructor's: an
  /// object that begins with zeros costs no flash.
  void start(const UartWiring& wiring, const Clocks& clocks, std::uint32_t baud);

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return rings_.read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// The line's interrupt.
  void on_interrupt();
  /// Once a millisecond, from an interrupt: sends what fits into one at the line's pace. On the part the send interrupt
  /// has done so already and this finds nothing to do; the emulator has no such interrupt.
  void on_millisecond();

  [[nodiscard]] bool waiting() const { return rings_.waiting(); }

 private:
  [[nodiscard]] bool send_one();

  std::uint32_t base_ = 0;
  std::uint32_t bytes_a_millisecond_ = 0;
  Rings<1024, 1024> rings_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::mcu::stm32f4
