// Faults common to all cables, whatever they carry.
#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace fencepost::test {

/// `corruption`: the share of bytes that arrive as another value. The same seed damages the same bytes.
struct Damage {
  double corruption = 0;
  std::uint32_t seed = 1;
};

/// Corrupts bytes of both directions, each with the same probability, by another value.
class Corruptor {
 public:
  explicit Corruptor(const Damage& damage) : random_(damage.seed) { set(damage.corruption); }

  void set(double probability) { threshold_ = probability * 4294967296.0; }
  std::uint8_t pass(std::uint8_t byte) {
    if (static_cast<double>(random_()) >= threshold_) return byte;
    ++corrupted_;
    return static_cast<std::uint8_t>(byte ^ (1U + random_() % 255U));
  }
  [[nodiscard]] std::uint64_t corrupted() const { return corrupted_; }

 private:
  std::mt19937 random_;  // its numbers are the same everywhere
  double threshold_ = 0;
  std::uint64_t corrupted_ = 0;
};

/// Each frame of the device passes it on its way to the driver.
using Tamper = std::function<std::vector<std::uint8_t>(const std::vector<std::uint8_t>&)>;

class Plug {
 public:
  explicit Plug(const Damage& damage) : corruptor_(damage) {}

  void unplug() { unplugged_ = true; }
  void replug() { unplugged_ = false; }
  /// Takes and gives nothing.
  void stall() { stalled_ = true; }
  void resume() { stalled_ = false; }
  [[nodiscard]] bool plugged() const { return !unplugged_; }

  Corruptor& corruptor() { return corruptor_; }
  void tamper(Tamper tamper) { tamper_ = std::move(tamper); }
  /// Bytes that the driver has sent, and the first of them since they were last cleared.
  [[nodiscard]] std::uint64_t written() const { return written_; }
  std::vector<std::uint8_t>& said() { return said_; }
  [[nodiscard]] std::uint64_t corrupted() const { return corruptor_.corrupted(); }
  /// Frames of the device that went on their way undamaged.
  [[nodiscard]] std::uint64_t whole_frames() const { return whole_frames_; }

 protected:
  /// `frame` as it arrives, but for single bytes.
  [[nodiscard]] std::vector<std::uint8_t> tampered(const std::vector<std::uint8_t>& frame) const {
    return tamper_ ? tamper_(frame) : frame;
  }

  void hear(std::span<const std::uint8_t> out) {
    written_ += out.size();
    for (std::size_t i = 0; i < out.size() && said_.size() < kKept; ++i) said_.push_back(out[i]);
  }

  static constexpr std::size_t kKept = 80;

  Corruptor corruptor_;
  Tamper tamper_;
  std::vector<std::uint8_t> said_;
  std::uint64_t written_ = 0;
  bool unplugged_ = false;
  bool stalled_ = false;
  std::uint64_t whole_frames_ = 0;
};

}  // namespace fencepost::test
