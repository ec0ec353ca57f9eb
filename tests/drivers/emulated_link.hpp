// A device of host/emulate on a byte link, with the faults of a real cable.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <random>
#include <span>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"
#include "hal/fake/stepped_clock.hpp"

namespace fencepost::test {

/// Corrupts bytes of both directions, each with the same probability, by another value.
class Corruptor {
 public:
  Corruptor(double probability, std::uint32_t seed) : random_(seed), threshold_(probability * 4294967296.0) {}

  std::uint8_t pass(std::uint8_t byte) {
    if (static_cast<double>(random_()) >= threshold_) return byte;
    ++corrupted_;
    return static_cast<std::uint8_t>(byte ^ (1U + random_() % 255U));
  }
  [[nodiscard]] std::uint32_t corrupted() const { return corrupted_; }

 private:
  std::mt19937 random_;  // its numbers are the same everywhere
  double threshold_;
  std::uint32_t corrupted_ = 0;
};

/// Device: `std::vector<std::uint8_t> take(std::uint8_t, base::Time)`. What it answers arrives at the line's pace.
template <class Device>
class EmulatedLink {
 public:
  EmulatedLink(Device& device, const fake::SteppedClock& clock, double corruption = 0, std::uint32_t seed = 1)
      : device_(device), clock_(clock), corruptor_(corruption, seed), last_read_(clock.now()) {}

  /// 115200 baud is 11.5 bytes a millisecond.
  void set_bytes_per_ms(std::int64_t bytes) { per_ms_ = bytes; }
  void unplug() { unplugged_ = true, waiting_.clear(); }
  void replug() { unplugged_ = false; }
  /// The line takes and gives nothing.
  void stall() { stalled_ = true; }
  void resume() { stalled_ = false; }
  void forget() { waiting_.clear(); }

  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (unplugged_) return base::Error::kGone;
    const base::Time now = clock_.now();
    budget_ = std::min<std::int64_t>(budget_ + (now - last_read_).raw * per_ms_ / 10, 4'096);
    last_read_ = now;
    if (waiting_.empty()) budget_ = 0;
    std::size_t count = 0;
    while (!stalled_ && count < in.size() && !waiting_.empty() && budget_ > 0) {
      in[count++] = waiting_.front();
      waiting_.pop_front();
      --budget_;
    }
    if (count == 0) return base::Error::kNotReady;
    return count;
  }

  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (unplugged_) return base::Error::kGone;
    if (stalled_) return base::Error::kFull;
    for (const std::uint8_t byte : out) {
      for (const std::uint8_t answer : device_.take(corruptor_.pass(byte), clock_.now())) inject(answer);
    }
    return out.size();
  }

  /// What the device says unasked.
  void inject(std::uint8_t byte) { waiting_.push_back(corruptor_.pass(byte)); }
  void inject(const std::vector<std::uint8_t>& bytes) {
    for (const std::uint8_t byte : bytes) inject(byte);
  }

  [[nodiscard]] const Corruptor& corruptor() const { return corruptor_; }
  [[nodiscard]] std::size_t waiting() const { return waiting_.size(); }

 private:
  Device& device_;
  const fake::SteppedClock& clock_;
  Corruptor corruptor_;
  std::deque<std::uint8_t> waiting_;
  std::int64_t per_ms_ = 12;
  std::int64_t budget_ = 0;
  base::Time last_read_;
  bool unplugged_ = false;
  bool stalled_ = false;
};

}  // namespace fencepost::test
