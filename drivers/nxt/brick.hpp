// An NXT brick on a packet link.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "drivers/nxt/conversation.hpp"
#include "hal/bus/packet_link.hpp"

namespace fencepost::nxt {

template <bus::PacketLink Link>
class Brick {
 public:
  explicit Brick(Link& link) : link_(link) {}

  /// Once per loop iteration, before the conversation's clients.
  void poll(base::Time now) {
    receive(now);
    const std::optional<Telegram> request = conversation_.due(now);
    if (!request) return;
    const base::Result<std::size_t> sent = link_.send(request->view());
    if (sent) conversation_.find_link();
    // A link that is full: the request times out as if it had been lost.
    if (!sent && sent.error() == base::Error::kGone) conversation_.lose_link(now);
  }

  [[nodiscard]] Conversation& conversation() { return conversation_; }
  [[nodiscard]] sensor::LinkState link() const { return conversation_.link(); }

 private:
  // One request is outstanding: more than a few replies per poll are late ones.
  static constexpr int kReplies = 4;

  void receive(base::Time now) {
    std::array<std::uint8_t, kLongestTelegram> in{};
    for (int i = 0; i < kReplies; ++i) {
      const base::Result<std::size_t> got = link_.receive(in);
      if (got) {
        conversation_.find_link();
        conversation_.take(std::span<const std::uint8_t>(in).first(*got), now);
      } else if (got.error() == base::Error::kGone) {
        return conversation_.lose_link(now);
      } else if (got.error() != base::Error::kBadInput) {
        return;
      }
    }
  }

  Link& link_;
  Conversation conversation_;
};

}  // namespace fencepost::nxt
