// A board of which only the wheels' counters matter; the test turns them.
#pragma once

#include <cstdint>

namespace fencepost::board {

struct Counters {
  std::uint32_t left = 0;
  std::uint32_t right = 0;
  bool started = false;
};
inline Counters counters;

inline void start_encoders() { counters.started = true; }
inline constexpr int kEncoderBits = 16;
/// Modulo 2^16, as the timers of real ones.
inline std::uint32_t left_count() { return counters.left & 0xFFFFU; }
inline std::uint32_t right_count() { return counters.right & 0xFFFFU; }

}  // namespace fencepost::board
