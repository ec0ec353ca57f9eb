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
  const std::uint32_t got = box.got;
  const std::size_t count = std::min<std::size_t>(box.put - got, in.size());
  if (count == 0 && !in.empty()) return base::Error::kNotReady;
  for (std::size_t i = 0; i < count; ++i) in[i] = box.to_board[(got + i) % Mailbox::kToBoard];
  box.got = static_cast<std::uint32_t>(got + count);
  return count;
}

base::Result<std::size_t> MailboxLink::write(std::span<const std::uint8_t> out) {
  volatile Mailbox& box = mailbox();
  const std::uint32_t said = box.said;
  const std::size_t count = std::min<std::size_t>(Mailbox::kToDesk - (said - box.told), out.size());
  if (count == 0 && !out.empty()) return base::Error::kFull;
  for (std::size_t i = 0; i < count; ++i) box.to_desk[(said + i) % Mailbox::kToDesk] = out[i];
  box.said = static_cast<std::uint32_t>(said + count);
  return count;
}

bool MailboxLink::waiting() const {
  const volatile Mailbox& box = mailbox();
  return there_ && box.put != box.got;
}

}  // namespace fencepost::board
