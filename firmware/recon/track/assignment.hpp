// The cheapest assignment of blobs to objects as a whole: a blob that suits two objects goes where it costs the others
// least. Hungarian method with integer costs, so the same on every target; fixed memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::recon {

inline constexpr std::uint8_t kNoMatch = std::numeric_limits<std::uint8_t>::max();
inline constexpr std::uint8_t kImpossible = std::numeric_limits<std::uint8_t>::max();

/// A column of assign()'s scratch memory: one for each object, one for each blob, which may stay unmatched, and one
/// more.
struct AssignmentColumn {
  std::int16_t potential = 0;
  std::int16_t slack = 0;
  std::uint8_t row = 0;        ///< matched to it, counted from 1; 0: free
  std::uint8_t came_from = 0;  ///< the column before it on the cheapest path
  bool visited = false;
};

/// `costs[object * blobs + blob]`, kImpossible where the pair cannot be. Fills `object_of`, one entry a blob; kNoMatch:
/// none. `scratch` has objects + blobs + 1 elements. Cost: about blobs^2 (objects + blobs) steps.
void assign(std::span<const std::uint8_t> costs, std::size_t objects, std::span<std::uint8_t> object_of,
            std::span<AssignmentColumn> scratch);

/// The same for at most `kObjects` objects.
template <std::size_t kObjects>
[[gnu::noinline]] void assign(std::span<const std::uint8_t> costs, std::size_t objects,
                              std::span<std::uint8_t> object_of) {
  std::array<AssignmentColumn, kObjects + sensor::kMaxBlobs + 1> scratch{};
  assign(costs, objects, object_of, scratch);
}

}  // namespace fencepost::recon
