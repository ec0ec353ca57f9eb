// The part's one serial line: 8N1, both ways through rings that its interrupt fills and empties.
#pragma once

#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/mcu/rings.hpp"

namespace fencepost::mcu::nrf51 {

/// The value of the part's baud register: of 2^32 / 16 MHz, in steps of 2^12 (table of chapter 29).
constexpr std::uint32_t baud_setting(std::uint32_t baud) {
  const std::uint64_t exact = (std::uint64_t{baud} << 32) / 16'000'000;
  return static_cast<std::uint32_t>((exact + 0x800) & 0xFFFF'F000U);
}
static_assert(baud_setting(9'600) == 0x0027'5000 && baud_setting(115'200) == 0x01D7'E000, "as the table has them");

class Uart {
 public:
  /// Called once, before anything else here. `Wire`: the part's pins. `baud`: 1200 to 1 000 000.
  template <class Wire>
  void start(Wire transmit, Wire receive, std::uint32_t baud) {
    transmit.drive(true);
    transmit.make_output();
    receive.make_input();
    begin(transmit.number, receive.number, baud);
  }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) { return rings_.read(in); }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);

  /// The line's interrupt. The part holds six bytes, 0.5 ms of 115200 baud: nobody may hold it off longer.
  void on_interrupt();
  /// Once a millisecond, from an interrupt: resumes sending where the line's own interrupt was lost. The emulator drops
  /// it when a peer that had stopped reading starts again.
  void on_millisecond() { go_on_sending(); }

  [[nodiscard]] bool waiting() const { return rings_.waiting(); }

 private:
  void begin(std::uint32_t transmit, std::uint32_t receive, std::uint32_t baud);
  void go_on_sending();
  [[nodiscard]] bool send_one();

  volatile bool sending_ = false;  ///< a byte is being sent; an event reports its end
  /// While the longest frame is worked on, 17 ms, 200 bytes come in. What goes out waits in the loop's own queue.
  Rings<512, 128> rings_;
};

static_assert(bus::ByteLink<Uart>);

}  // namespace fencepost::mcu::nrf51
