// The emulated brick on a USB pipe: replies after a while, in order, the brick's telegrams whole.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "hal/bus/packet_link.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/nxt.hpp"

namespace fencepost::test {

class EmulatedUsb {
 public:
  EmulatedUsb(emulate::NxtBrick& brick, const fake::SteppedClock& clock) : brick_(brick), clock_(clock) {}

  base::Result<std::size_t> send(std::span<const std::uint8_t> out) {
    if (unplugged) return base::Error::kGone;
    if (const auto reply = brick_.telegram({out.begin(), out.end()}, clock_.now())) {
      replies_.emplace_back(clock_.now() + delay, *reply);
    }
    return out.size();
  }
  base::Result<std::size_t> receive(std::span<std::uint8_t> in) {
    if (unplugged) return replies_.clear(), base::Error::kGone;
    if (replies_.empty() || replies_.front().first > clock_.now()) return base::Error::kNotReady;
    const std::vector<std::uint8_t> reply = replies_.front().second;
    replies_.pop_front();
    std::copy(reply.begin(), reply.end(), in.begin());
    return reply.size();
  }

  bool unplugged = false;
  base::Duration delay = base::milliseconds(2);

 private:
  emulate::NxtBrick& brick_;
  const fake::SteppedClock& clock_;
  std::deque<std::pair<base::Time, std::vector<std::uint8_t>>> replies_;
};

static_assert(bus::PacketLink<EmulatedUsb>);

}  // namespace fencepost::test
