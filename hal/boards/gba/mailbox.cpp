#include "hal/boards/gba/mailbox.hpp"

#include <algorithm>

namespace fencepost::board {
namespace {

volatile Mailbox& mailbox() {
  return *reinterpret_cast<volatile Mailbox*>(static_cast<std::uintptr_t>(Mailbox::kAddress));
}

}  // namespace

bool MailboxLink::start() {
  volatile Mailbox& box = mailbox();
  there_ = box.desk[0] == Mailbox::kDesk && box.desk[1] == ~Mailbox::kDesk;
  if (there_) box.board = Mailbox::kBoard;
  return there_;
}

base::Result<std::size_t> MailboxLink::read(std::span<std::uint8_t> in) {
  volatile Mailbox& box = mailbox();
  const std::uint32_t got = box.board_received;
  const std::size_t count = std::min<std::size_t>(box.desk_sent - got, in.size());
  if (count == 0 && !in.empty()) return base::Error::kNotReady;
  for (std::size_t i = 0; i < count; ++i) in[i] = box.to_board[(got + i) % Mailbox::kToBoard];
  box.board_received = static_cast<std::uint32_t>(got + count);
  return count;
}

base::Result<std::size_t> MailboxLink::write(std::span<const std::uint8_t> out) {
  volatile Mailbox& box = mailbox();
  const std::uint32_t said = box.board_sent;
  const std::size_t count = std::min<std::size_t>(Mailbox::kToDesk - (said - box.desk_received), out.size());
  if (count == 0 && !out.empty()) return base::Error::kFull;
  for (std::size_t i = 0; i < count; ++i) box.to_desk[(said + i) % Mailbox::kToDesk] = out[i];
  box.board_sent = static_cast<std::uint32_t>(said + count);
  return count;
}

bool MailboxLink::waiting() const {
  const volatile Mailbox& box = mailbox();
  return there_ && box.desk_sent != box.board_received;
}

}  // namespace fencepost::board
