// Faults common to all cables, whatever they carry.
#pragma once

#include <cstdint>
#include <random>

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
  [[nodiscard]] std::uint64_t corrupted() const { return corruptor_.corrupted(); }
  /// Frames of the device that went on their way undamaged.
  [[nodiscard]] std::uint64_t whole_frames() const { return whole_frames_; }

 protected:
  Corruptor corruptor_;
  bool unplugged_ = false;
  bool stalled_ = false;
  std::uint64_t whole_frames_ = 0;
};

}  // namespace fencepost::test
