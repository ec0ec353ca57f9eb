// Bytes on their way to a device, for a link that takes only some of them at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/base/fixed.hpp"

namespace fencepost::serial {

template <std::size_t Capacity>
class Outbox {
 public:
  /// All or nothing: half a command would be another command. False when it does not fit.
  [[nodiscard]] constexpr bool put(std::span<const std::uint8_t> bytes) {
    if (bytes_.size() + bytes.size() > Capacity) return false;
    for (const std::uint8_t byte : bytes) (void)bytes_.push_back(byte);
    return true;
  }
  [[nodiscard]] constexpr bool put(std::string_view text) {
    if (bytes_.size() + text.size() > Capacity) return false;
    for (const char c : text) (void)bytes_.push_back(static_cast<std::uint8_t>(c));
    return true;
  }
  constexpr void clear() {
    bytes_.clear();
    sent_ = 0;
  }

  [[nodiscard]] constexpr std::span<const std::uint8_t> waiting() const { return bytes_.view().subspan(sent_); }
  /// The link took the first `count` of waiting().
  constexpr void sent(std::size_t count) {
    FENCEPOST_CHECK(count <= bytes_.size() - sent_);
    sent_ += count;
    if (sent_ == bytes_.size()) clear();
  }

 private:
  base::FixedVector<std::uint8_t, Capacity> bytes_;
  std::size_t sent_ = 0;
};

}  // namespace fencepost::serial
