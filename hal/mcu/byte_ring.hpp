// Bytes between an interrupt and the loop. One side writes, the other reads; neither ever waits.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace fencepost::mcu {

/// Holds N bytes, a power of two. Safe between one writer and one reader on the same core, one of which may interrupt
/// the other. The indices run freely, and each is written by one side only. Fences are for the compiler; one core sees
/// its own stores in order.
template <std::size_t N>
class ByteRing {
  static_assert(N >= 2 && (N & (N - 1)) == 0 && N <= 0x8000, "indices wrap at 2^16");

 public:
  /// Writer's side. False, and nothing stored, when full.
  [[nodiscard]] bool put(std::uint8_t byte) {
    const std::uint16_t head = head_.load(std::memory_order_relaxed);
    if (static_cast<std::uint16_t>(head - tail_.load(std::memory_order_relaxed)) == N) return false;
    std::atomic_signal_fence(std::memory_order_acquire);
    bytes_[head % N] = byte;
    std::atomic_signal_fence(std::memory_order_release);
    head_.store(static_cast<std::uint16_t>(head + 1), std::memory_order_relaxed);
    return true;
  }
  /// Reader's side. False when empty.
  [[nodiscard]] bool get(std::uint8_t& byte) {
    const std::uint16_t tail = tail_.load(std::memory_order_relaxed);
    if (head_.load(std::memory_order_relaxed) == tail) return false;
    std::atomic_signal_fence(std::memory_order_acquire);
    byte = bytes_[tail % N];
    std::atomic_signal_fence(std::memory_order_release);
    tail_.store(static_cast<std::uint16_t>(tail + 1), std::memory_order_relaxed);
    return true;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::uint16_t>(head_.load(std::memory_order_relaxed) - tail_.load(std::memory_order_relaxed));
  }
  [[nodiscard]] bool empty() const { return size() == 0; }

 private:
  std::array<std::uint8_t, N> bytes_{};
  std::atomic<std::uint16_t> head_{0};
  std::atomic<std::uint16_t> tail_{0};
};

}  // namespace fencepost::mcu
