// The console through memory that an emulator can access: no emulator models the link port's UART.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::board {

/// Two rings, each with one writer and one reader; the indices run freely. The desk side is not part of this image: it
/// writes `desk`, `to_board`, `desk_sent` and `desk_received`, the board everything else.
struct Mailbox {
  static constexpr std::uint32_t kAddress = 0x0200'0000;  ///< first in the external work memory
  static constexpr std::uint32_t kDesk = 0x6B73'6544;     ///< "Desk"
  static constexpr std::uint32_t kBoard = 0x6472'6F42;    ///< "Bord"
  static constexpr std::size_t kToBoard = 1024;
  static constexpr std::size_t kToDesk = 2048;

  std::uint32_t desk[2];         ///< kDesk, ~kDesk before the start: an emulator is attached
  std::uint32_t board;           ///< kBoard: the board has seen that
  std::uint32_t desk_sent;       ///< bytes
  std::uint32_t board_received;  ///< of those
  std::uint32_t board_sent;      ///< bytes
  std::uint32_t desk_received;   ///< of those
  std::uint8_t to_board[kToBoard];
  std::uint8_t to_desk[kToDesk];
};

class MailboxLink {
 public:
  /// True if there is a desk; then the rest may be used.
  bool start();

  [[nodiscard]] bool there() const { return there_; }
  base::Result<std::size_t> read(std::span<std::uint8_t> in);
  base::Result<std::size_t> write(std::span<const std::uint8_t> out);
  [[nodiscard]] bool waiting() const;

 private:
  bool there_ = false;
};

static_assert(bus::ByteLink<MailboxLink>);

}  // namespace fencepost::board
