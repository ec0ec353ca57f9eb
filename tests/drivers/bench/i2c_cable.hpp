// A device of host/emulate on an I2C bus, with the faults of a real one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/bus/i2c_bus.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/models/i2c_device.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

/// Each transfer takes `turns` calls of finish. Stalled, it never ends.
class I2cCable : public Plug {
 public:
  I2cCable(emulate::I2cDevice& device, const fake::SteppedClock& clock, const Damage& damage = {})
      : Plug(damage), device_(device), clock_(clock) {}

  /// A read of this register is a frame.
  void count_frames(std::uint8_t from_register) { frames_from_ = from_register; }

  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    if (unplugged_) return base::Error::kGone;
    if (answer_ || out.size() > bus::kMaxI2cTransfer) return base::Error::kFull;
    longest_read_ = std::max(longest_read_, expected);
    std::vector<std::uint8_t> bytes;
    for (const std::uint8_t byte : out) bytes.push_back(corruptor_.pass(byte));
    reads_frame_ = frames_from_ && bytes == std::vector<std::uint8_t>{*frames_from_};
    answer_ = device_.transfer(address, bytes, expected, clock_.now());
    refused_ = !answer_;
    if (!answer_) answer_.emplace();
    turns_left_ = turns;
    ++transfers_;
    hear(out);
    return out.size();
  }

  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    if (unplugged_) return answer_.reset(), base::Error::kGone;
    if (!answer_ || stalled_ || turns_left_-- > 0) return base::Error::kNotReady;
    std::vector<std::uint8_t> bytes = *answer_;
    answer_.reset();
    if (refused_) return base::Error::kRefused;
    const std::uint64_t before = corrupted();
    if (reads_frame_) bytes = tampered(bytes);
    bytes.resize(std::min(bytes.size(), in.size()));
    for (std::size_t i = 0; i < bytes.size(); ++i) in[i] = corruptor_.pass(bytes[i]);
    if (reads_frame_ && corrupted() == before) ++whole_frames_;
    return bytes.size();
  }

  void forget() {}
  [[nodiscard]] std::size_t waiting() const { return 0; }
  [[nodiscard]] std::size_t longest_read() const { return longest_read_; }
  [[nodiscard]] std::uint32_t transfers() const { return transfers_; }

  int turns = 1;

 private:
  emulate::I2cDevice& device_;
  const fake::SteppedClock& clock_;
  std::optional<std::uint8_t> frames_from_;
  std::optional<std::vector<std::uint8_t>> answer_;
  bool reads_frame_ = false;
  bool refused_ = false;
  int turns_left_ = 0;
  std::size_t longest_read_ = 0;
  std::uint32_t transfers_ = 0;
};

static_assert(bus::I2cBus<I2cCable>);

}  // namespace fencepost::test
