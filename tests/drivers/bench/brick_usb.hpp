// The emulated NXT brick on a USB pipe: replies after a while, in order, the brick's telegrams whole.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "hal/bus/packet_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/models/nxt.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

class BrickUsb : public Plug {
 public:
  using IsFrame = bool (*)(std::span<const std::uint8_t>);

  BrickUsb(emulate::NxtBrick& brick, const fake::SteppedClock& clock, const Damage& damage = {})
      : Plug(damage), brick_(brick), clock_(clock) {}

  void count_frames(IsFrame is_frame) { is_frame_ = is_frame; }
  void unplug() { Plug::unplug(), forget(); }
  void forget() { replies_.clear(); }

  base::Result<std::size_t> send(std::span<const std::uint8_t> out) {
    if (unplugged_) return base::Error::kGone;
    if (stalled_) return base::Error::kFull;
    hear(out);
    const auto reply = brick_.telegram(passed(out), clock_.now());
    if (!reply) return out.size();
    const std::uint64_t before = corrupted();
    const bool is_frame = is_frame_ != nullptr && is_frame_(*reply);
    const std::vector<std::uint8_t> sent = is_frame ? tampered(*reply) : *reply;
    replies_.emplace_back(clock_.now() + delay, passed(sent));
    if (is_frame && sent == *reply && corrupted() == before) ++whole_frames_;
    return out.size();
  }
  base::Result<std::size_t> receive(std::span<std::uint8_t> in) {
    if (unplugged_) return base::Error::kGone;
    if (stalled_ || replies_.empty() || replies_.front().first > clock_.now()) return base::Error::kNotReady;
    const std::vector<std::uint8_t> reply = replies_.front().second;
    replies_.pop_front();
    std::copy(reply.begin(), reply.end(), in.begin());
    return reply.size();
  }
  [[nodiscard]] std::size_t waiting() const { return replies_.size(); }

  base::Duration delay = base::milliseconds(2);

 private:
  std::vector<std::uint8_t> passed(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> out;
    for (const std::uint8_t byte : bytes) out.push_back(corruptor_.pass(byte));
    return out;
  }

  emulate::NxtBrick& brick_;
  const fake::SteppedClock& clock_;
  IsFrame is_frame_ = nullptr;
  std::deque<std::pair<base::Time, std::vector<std::uint8_t>>> replies_;
};

static_assert(bus::PacketLink<BrickUsb>);

}  // namespace fencepost::test
