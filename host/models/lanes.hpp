// Four numbers in the place of one, for what is done to four outlines at once: each lane has the bits that a float
// would have. GCC and clang make of it what the processor has.
#pragma once

#include <cstddef>
#include <cstdint>

namespace fencepost::recon {

inline constexpr std::size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = std::int32_t __attribute__((vector_size(kLanes * sizeof(float))));  ///< -1: yes, 0: no

}  // namespace fencepost::recon
