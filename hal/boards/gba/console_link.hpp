// The console: the link port, or the mailbox where an emulator has announced itself. Chosen when the board starts, so
// the tested image is the flashed one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/boards/gba/mailbox.hpp"
#include "hal/mcu/gba/uart.hpp"

namespace fencepost::board {

class ConsoleLink {
 public:
  void start(std::uint32_t baud) {
    if (!mailbox_.start()) uart_.start(baud);
  }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    return mailbox_.there() ? mailbox_.read(in) : uart_.read(in);
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    return mailbox_.there() ? mailbox_.write(out) : uart_.write(out);
  }
  [[nodiscard]] bool waiting() const { return mailbox_.there() ? mailbox_.waiting() : uart_.waiting(); }

  /// From an interrupt.
  void serve() {
    if (!mailbox_.there()) uart_.serve();
  }

 private:
  mcu::gba::Uart uart_;
  MailboxLink mailbox_;
};

static_assert(bus::ByteLink<ConsoleLink>);

}  // namespace fencepost::board
