// Four numbers in the place of one, for what is done to four outlines at once: each lane has the bits that a float
// would have. GCC and clang make of it what the processor has.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace fencepost::recon {

inline constexpr std::size_t kLanes = 4;
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));
using LaneMask = std::int32_t __attribute__((vector_size(kLanes * sizeof(float))));  ///< -1: yes, 0: no

/// Whether a pivot is kept, by lane.
template <class Number>
struct KeptOf {
  using Type = bool;
};
template <>
struct KeptOf<Lanes> {
  using Type = LaneMask;
};
template <class Number>
using Kept = typename KeptOf<Number>::Type;

inline bool exceeds(float a, float b) { return a > b; }
inline LaneMask exceeds(const Lanes& a, const Lanes& b) { return a > b; }

/// Nothing to go on with. Lanes always go on: one that is lost has no meaning.
inline bool all_lost(bool kept) { return !kept; }
inline bool all_lost(const LaneMask& /*kept*/) { return false; }

inline float root(float x) { return std::sqrt(x); }
inline Lanes root(const Lanes& x) {
  Lanes roots{};
  for (std::size_t l = 0; l < kLanes; ++l) roots[l] = std::sqrt(x[l]);
  return roots;
}

}  // namespace fencepost::recon
