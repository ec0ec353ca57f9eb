// A serial line between a driver and an emulated device, with everything that lines do wrong; random, but the same
// each time.
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "hal/base/result.hpp"
#include "hal/bus/byte_link.hpp"

namespace fencepost::serial {

class Wire {
 public:
  explicit Wire(std::uint64_t seed = 1) : random_(seed) {}

  // The driver's end: a bus::ByteLink.
  base::Result<std::size_t> read(std::span<std::uint8_t> in) {
    if (!plugged_) return base::Error::kGone;
    if (stalled_ || to_driver_.empty()) return base::Error::kNotReady;
    std::size_t count = 0;
    while (count < in.size() && !to_driver_.empty()) {
      in[count++] = static_cast<std::uint8_t>(to_driver_.front());
      to_driver_.pop_front();
    }
    return count;
  }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) {
    if (!plugged_) return base::Error::kGone;
    if (stalled_) return base::Error::kFull;
    std::size_t count = 0;
    // A few bytes at a time, as a full buffer takes them.
    while (count < out.size() && count < 16) to_device_ += damaged(static_cast<char>(out[count++]));
    return count;
  }

  // The device's end. Past its capacity, as a port's buffer, it forgets what comes.
  void from_device(std::string_view bytes) {
    for (const char byte : bytes) {
      if (plugged_ && to_driver_.size() < kCapacity) to_driver_.push_back(damaged(byte));
    }
  }
  std::string to_device() { return std::exchange(to_device_, {}); }

  // Faults.
  void damage_one_byte_in(std::uint32_t bytes) { damage_one_in_ = bytes; }
  void stall(bool on) { stalled_ = on; }
  void unplug() {
    plugged_ = false;
    to_driver_.clear();
    to_device_.clear();
  }
  void replug() { plugged_ = true; }
  [[nodiscard]] std::uint32_t damaged_bytes() const { return damaged_; }
  [[nodiscard]] bool plugged() const { return plugged_; }
  std::mt19937_64& random() { return random_; }
  bool chance(std::uint32_t one_in) { return random_() % one_in == 0; }

 private:
  static constexpr std::size_t kCapacity = 4096;

  char damaged(char byte) {
    if (damage_one_in_ == 0 || !chance(damage_one_in_)) return byte;
    ++damaged_;
    return static_cast<char>(byte ^ static_cast<char>(1 + random_() % 255));
  }

  std::mt19937_64 random_;
  std::deque<char> to_driver_;
  std::string to_device_;
  std::uint32_t damage_one_in_ = 0;
  std::uint32_t damaged_ = 0;
  bool stalled_ = false;
  bool plugged_ = true;
};

static_assert(bus::ByteLink<Wire>);

}  // namespace fencepost::serial
