// Four numbers in place of one, for four outlines at once: each lane has the bits that a float would have. GCC and
// clang compile it to the processor's own vectors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fencepost::recon {

inline constexpr std::size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = std::int32_t __attribute__((vector_size(kLanes * sizeof(float))));  ///< -1: yes, 0: no

}  // namespace fencepost::recon
