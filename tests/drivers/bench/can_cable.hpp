// A CAN bus: its own checksum leaves no damaged frame, so a damaged byte loses its frame.
#pragma once

#include <cstdint>
#include <deque>

#include "hal/bus/can_bus.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

class CanCable : public Plug {
 public:
  using Plug::Plug;

  void put(const bus::CanFrame& frame) {
    if (!stalled_ && !unplugged_) waiting_.push_back(frame);
  }
  void unplug() { Plug::unplug(), forget(); }
  void forget() { waiting_.clear(); }

  base::Result<bus::CanFrame> receive() {
    if (unplugged_) return base::Error::kGone;
    if (stalled_ || waiting_.empty()) return base::Error::kNotReady;
    const bus::CanFrame frame = waiting_.front();
    waiting_.pop_front();
    const std::uint64_t before = corrupted();
    for (const std::uint8_t byte : frame.bytes()) (void)corruptor_.pass(byte);
    const std::vector<std::uint8_t> sent = {frame.bytes().begin(), frame.bytes().end()};
    if (corrupted() != before || tampered(sent) != sent) return neighbour_whole_ = false, base::Error::kBadInput;
    // A sample needs a frame of each wheel.
    whole_frames_ += neighbour_whole_ ? 1U : 0U;
    neighbour_whole_ = !neighbour_whole_;
    return frame;
  }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  std::deque<bus::CanFrame> waiting_;
  bool neighbour_whole_ = false;
};

static_assert(bus::CanBus<CanCable>);

}  // namespace fencepost::test
