// One transfer of an I2C master: its bytes, state and time limit, shared by the program and an interrupt.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"

namespace fencepost::mcu {

class I2cTransfer {
 public:
  enum class State : std::uint8_t { kIdle, kBusy, kDone };

  // The program's side.
  /// Takes the bytes to write. kFull: one is under way, it is too long, or it is of no bytes at all.
  base::Result<std::size_t> prepare(std::span<const std::uint8_t> out, std::size_t expected) {
    if (out.size() > out_.size() || expected > in_.size() || (out.empty() && expected == 0)) return base::Error::kFull;
    if (state() != State::kIdle) return base::Error::kFull;
    std::copy(out.begin(), out.end(), out_.begin());
    to_send_ = out.size();
    expected_ = expected;
    sent_ = received_ = 0;
    refused_ = false;
    return out.size();
  }
  /// Started: everything that the interrupt needs is in memory.
  void begin() {
    left_ = kPatience;
    std::atomic_signal_fence(std::memory_order_release);
    state_.store(State::kBusy, std::memory_order_relaxed);
  }
  [[nodiscard]] State state() const { return state_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool late() const { return left_ == 0; }
  /// Its outcome; the next transfer may begin.
  base::Result<std::size_t> end(std::span<std::uint8_t> in) {
    std::atomic_signal_fence(std::memory_order_acquire);
    state_.store(State::kIdle, std::memory_order_relaxed);
    if (refused_) return base::Error::kRefused;
    const std::size_t count = std::min(in.size(), received_);
    std::copy_n(in_.begin(), count, in.begin());
    return count;
  }

  /// There is none, whatever became of the last; the master's interrupts are off.
  void abandon() { state_.store(State::kIdle, std::memory_order_relaxed); }

  // The interrupts' side; for the program only while no transfer is active or the master's interrupts are off.
  [[nodiscard]] bool reads_only() const { return to_send_ == 0; }
  [[nodiscard]] bool all_sent() const { return sent_ == to_send_; }
  [[nodiscard]] std::uint8_t next() { return out_[sent_++]; }
  [[nodiscard]] std::size_t expected() const { return expected_; }
  [[nodiscard]] std::size_t missing() const { return expected_ - received_; }
  /// Something has to be missing.
  void take(std::uint8_t byte) { in_[received_++] = byte; }
  void refuse() { refused_ = true; }
  [[nodiscard]] bool refused() const { return refused_; }
  /// An interrupt that was pending when the transfer was given up still comes, and finds none.
  void done() {
    if (state() != State::kBusy) return;
    std::atomic_signal_fence(std::memory_order_release);
    state_.store(State::kDone, std::memory_order_relaxed);
  }
  /// Once a millisecond.
  void on_millisecond() {
    if (left_ != 0) left_ = left_ - 1;
  }

 private:
  /// ms: 65 bytes take 6 at 100 kHz; the rest is for clock stretching.
  static constexpr std::uint32_t kPatience = 30;

  std::array<std::uint8_t, bus::kMaxI2cTransfer> out_{};
  std::array<std::uint8_t, bus::kMaxI2cTransfer> in_{};
  std::size_t to_send_ = 0;
  std::size_t expected_ = 0;
  std::size_t sent_ = 0;
  std::size_t received_ = 0;
  bool refused_ = false;
  volatile std::uint32_t left_ = 0;  ///< ms
  std::atomic<State> state_{State::kIdle};
};

}  // namespace fencepost::mcu
