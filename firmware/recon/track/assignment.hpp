// The cheapest assignment of blobs to objects as a whole: a blob that suits two objects goes where it costs the others
// least. Hungarian method with integer costs, so the same on every target; fixed memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace fencepost::recon {

inline constexpr std::uint8_t kNoMatch = std::numeric_limits<std::uint8_t>::max();
inline constexpr std::uint8_t kImpossible = std::numeric_limits<std::uint8_t>::max();

/// Leaving a blob unmatched costs this. A pair that costs more is not made, and a good pair is not given up to find a
/// partner for a blob that fits nowhere.
inline constexpr std::uint8_t kUnmatchedCost = 160;

/// `costs[object * blobs + blob]`, kImpossible where the pair cannot be.
/// Fills `object_of` (one entry a blob; kNoMatch: none). At most 16 blobs and 32 objects; costs about blobs^2 *
/// (objects
/// + blobs) steps.
void assign(std::span<const std::uint8_t> costs, std::size_t objects, std::span<std::uint8_t> object_of);

}  // namespace fencepost::recon
