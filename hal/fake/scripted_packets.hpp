// A packet link that plays a script: telegrams, or failed receives, and keeps what was sent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/base/fixed.hpp"
#include "hal/bus/packet_link.hpp"

namespace fencepost::fake {

/// The answer of one receive, once as many telegrams as `after` have been sent.
struct PacketStep {
  std::span<const std::uint8_t> bytes;
  std::optional<base::Error> error;
  std::size_t after = 0;
};

/// After the script: kNotReady. At most `Capacity` telegrams of 64 bytes are kept.
template <std::size_t Capacity>
class ScriptedPackets {
 public:
  using Packet = base::FixedVector<std::uint8_t, 64>;

  /// The script and its bytes are borrowed.
  constexpr explicit ScriptedPackets(std::span<const PacketStep> script) : script_(script) {}

  constexpr base::Result<std::size_t> send(std::span<const std::uint8_t> out) {
    if (gone_) return base::Error::kGone;
    Packet packet;
    for (const std::uint8_t byte : out) {
      if (!packet.push_back(byte)) return base::Error::kFull;
    }
    if (!sent_.push_back(packet)) return base::Error::kFull;
    return out.size();
  }

  constexpr base::Result<std::size_t> receive(std::span<std::uint8_t> in) {
    if (gone_) return base::Error::kGone;
    if (step_ == script_.size() || sent_.size() < script_[step_].after) return base::Error::kNotReady;
    const PacketStep& step = script_[step_++];
    if (step.error) return *step.error;
    if (step.bytes.size() > in.size()) return base::Error::kBadInput;
    std::copy_n(step.bytes.begin(), step.bytes.size(), in.begin());
    return step.bytes.size();
  }

  constexpr void unplug() { gone_ = true; }
  constexpr void replug() { gone_ = false; }

  [[nodiscard]] constexpr std::span<const Packet> sent() const { return sent_.view(); }
  [[nodiscard]] constexpr bool finished() const { return step_ == script_.size(); }

 private:
  std::span<const PacketStep> script_;
  std::size_t step_ = 0;
  bool gone_ = false;
  base::FixedVector<Packet, Capacity> sent_;
};

static_assert(bus::PacketLink<ScriptedPackets<4>>);

}  // namespace fencepost::fake
