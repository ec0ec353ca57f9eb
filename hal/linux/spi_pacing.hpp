// Limits the bytes that a stream over SPI clocks, and keeps those that came in unasked.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"

namespace fencepost::linux {

/// One grant a millisecond of at most kGrant bytes: 64 kB/s, several times what a Pixy2 sends. The limit ends a loop
/// that reads until nothing is left.
class SpiPacing {
 public:
  static constexpr std::size_t kGrant = 64;
  static constexpr base::Duration kInterval = base::milliseconds(1);

  void tend(base::Time now) {
    if (last_ && now >= *last_ && now - *last_ < kInterval) return;
    last_ = now;
    granted_ = kGrant;
  }

  /// How many of `wanted` bytes may be clocked in now; they count as used.
  std::size_t use(std::size_t wanted) {
    const std::size_t count = std::min(wanted, granted_);
    granted_ -= count;
    return count;
  }

  /// How many bytes may be written now: what comes in meanwhile has to fit.
  [[nodiscard]] std::size_t room() const { return kGrant - kept_.size(); }
  void keep(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) static_cast<void>(kept_.push_back(byte));
  }
  /// Moves what was kept to the front of `in`, oldest first; how much.
  std::size_t take(std::span<std::uint8_t> in) {
    std::size_t count = 0;
    while (count < in.size() && !kept_.empty()) {
      in[count++] = kept_.front();
      kept_.pop_front();
    }
    return count;
  }
  void forget() { kept_.clear(); }

 private:
  std::optional<base::Time> last_;
  std::size_t granted_ = 0;
  base::Ring<std::uint8_t, kGrant> kept_;
};

}  // namespace fencepost::linux
