// Finds messages in a stream of bytes and resynchronises after damage.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/check.hpp"
#include "hal/base/units.hpp"

namespace fencepost::wire {

/// Classification of the first bytes.
enum class Front : std::uint8_t {
  kIncomplete,  ///< may become a message
  kNoise,       ///< no message starts here
  kDamaged,     ///< looked like a message, but its checksum or end says otherwise
  kMessage,
};

/// `size`: bytes of the message, or to skip; not used for kIncomplete.
struct Verdict {
  Front front = Front::kIncomplete;
  std::size_t size = 0;
};

/// Bytes to skip so that the next one is `sync`, at least one.
constexpr std::size_t skip_to(std::span<const std::uint8_t> bytes, std::uint8_t sync) {
  std::size_t at = 1;
  while (at < bytes.size() && bytes[at] != sync) ++at;
  return at;
}

/// `Examine` is a pure function of one byte or more, `Capacity` the size of the longest message. A message that turns
/// out damaged is scanned again from its second byte, so a good one that it seemed to contain is not lost.
template <std::size_t Capacity, Verdict (*Examine)(std::span<const std::uint8_t>)>
class Scanner {
 public:
  /// `sink(message, first_byte)` is called for each whole message; it must not call back. After damage, the time of the
  /// first byte is that of the bytes scanned again: early by at most their duration.
  template <class Sink>
  void feed(std::uint8_t byte, base::Time now, Sink&& sink) {
    if (size_ == 0) first_byte_ = now;
    bytes_[size_++] = byte;
    while (size_ > 0) {
      const Verdict verdict = Examine(pending());
      if (verdict.front == Front::kIncomplete && size_ < Capacity) return;
      if (verdict.front == Front::kMessage) {
        ++messages_;
        sink(pending().first(verdict.size), first_byte_);
      } else if (verdict.front == Front::kDamaged) {
        ++damaged_;
      }
      drop(verdict.front == Front::kIncomplete ? 1 : verdict.size, now);
    }
  }

  /// Discards a partial message.
  void reset() { size_ = 0; }

  [[nodiscard]] std::span<const std::uint8_t> pending() const { return {bytes_.data(), size_}; }
  [[nodiscard]] std::uint32_t messages() const { return messages_; }
  [[nodiscard]] std::uint32_t damaged() const { return damaged_; }

 private:
  void drop(std::size_t count, base::Time now) {
    FENCEPOST_CHECK(count > 0 && count <= size_);
    for (std::size_t i = count; i < size_; ++i) bytes_[i - count] = bytes_[i];
    size_ -= count;
    if (size_ == 1) first_byte_ = now;
  }

  std::array<std::uint8_t, Capacity> bytes_{};
  std::size_t size_ = 0;
  base::Time first_byte_;
  std::uint32_t messages_ = 0;
  std::uint32_t damaged_ = 0;
};

}  // namespace fencepost::wire
