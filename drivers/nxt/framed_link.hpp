// A packet link made of a byte link: Bluetooth's serial port, each telegram behind its length.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "drivers/nxt/telegram.hpp"
#include "drivers/wire/endian.hpp"
#include "drivers/wire/flush.hpp"
#include "drivers/wire/scanner.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/bus/packet_link.hpp"

namespace fencepost::nxt {

inline constexpr std::size_t kLengthPrefix = 2;

/// For wire::Scanner. The prefix, u16 little-endian, is no sync mark. Telegrams differ from noise in two ways: they are
/// replies (02), and no known command has a longer one.
inline wire::Verdict examine_framed(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < 2) return {};
  const std::size_t length = wire::little_u16(bytes, 0);
  if (length < 3 || length > kLongestTelegram) return {wire::Front::kDamaged, 1};
  if (bytes.size() > kLengthPrefix && bytes[kLengthPrefix] != 0x02) return {wire::Front::kDamaged, 1};
  if (bytes.size() < kLengthPrefix + length) return {};
  return {wire::Front::kMessage, kLengthPrefix + length};
}

/// One telegram each way at a time. Sending discards a partly received telegram: a repeated request no longer waits for
/// it, and a damaged length must not swallow the reply.
template <bus::ByteLink Link>
class FramedLink {
 public:
  explicit FramedLink(Link& link) : link_(link) {}

  base::Result<std::size_t> send(std::span<const std::uint8_t> out) {
    if (!wire::flush(outbox_, link_)) return lose();
    if (!outbox_.waiting().empty() || out.size() > kLongestTelegram) return base::Error::kFull;
    const std::array<std::uint8_t, kLengthPrefix> prefix = {static_cast<std::uint8_t>(out.size()), 0};
    wire::replace(outbox_, prefix);
    (void)outbox_.put(out);
    scanner_.reset();
    if (!wire::flush(outbox_, link_)) return lose();
    return out.size();
  }

  base::Result<std::size_t> receive(std::span<std::uint8_t> in) {
    if (!wire::flush(outbox_, link_)) return lose();
    std::array<std::uint8_t, 1> byte{};
    // A byte at a time: what follows a telegram waits in the link for the next call. Bounded by two whole telegrams.
    for (std::size_t i = 0; i < 2 * kLongestFrame; ++i) {
      const base::Result<std::size_t> got = link_.read(byte);
      if (!got) return got.error() == base::Error::kGone ? lose() : base::Error::kNotReady;
      if (*got == 0) return base::Error::kNotReady;
      base::Result<std::size_t> found = base::Error::kNotReady;
      scanner_.feed(byte[0], {}, [&](std::span<const std::uint8_t> message, base::Time) {
        found = deliver(message.subspan(kLengthPrefix), in);
      });
      if (found || found.error() != base::Error::kNotReady) return found;
    }
    return base::Error::kNotReady;
  }

 private:
  static constexpr std::size_t kLongestFrame = kLengthPrefix + kLongestTelegram;

  static base::Result<std::size_t> deliver(std::span<const std::uint8_t> telegram, std::span<std::uint8_t> in) {
    if (telegram.size() > in.size()) return base::Error::kBadInput;
    std::copy(telegram.begin(), telegram.end(), in.begin());
    return telegram.size();
  }

  base::Error lose() {
    outbox_.clear();
    scanner_.reset();
    return base::Error::kGone;
  }

  Link& link_;
  serial::Outbox<kLongestFrame> outbox_;
  wire::Scanner<kLongestFrame, examine_framed> scanner_;
};

}  // namespace fencepost::nxt
