// Counters of the inputs and of how they were used.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fencepost::console {

/// Why a well-formed frame was not used.
enum class Refusal : std::uint8_t { kNoPose, kOdometryGap, kNoCamera, kQueue };
inline constexpr std::size_t kRefusals = 4;

/// Since boot.
struct Counters {
  std::uint32_t frames = 0;  ///< frames used
  std::uint32_t blobs = 0;   ///< blobs in them
  std::uint32_t blobs_dropped = 0;
  std::uint32_t odometry = 0;
  std::uint32_t rejected = 0;
  std::array<std::uint32_t, kRefusals> refused{};
  std::uint32_t records_dropped = 0;
  std::uint32_t loop_us_max = 0;

  [[nodiscard]] std::uint32_t refused_in_all() const {
    std::uint32_t sum = 0;
    for (const std::uint32_t count : refused) sum += count;
    return sum;
  }
};

}  // namespace fencepost::console
