// Known things and floor, and how they count for `sectors` and `ways`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/guard/seen_floor.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/hybrid/node_directions.hpp"

namespace fencepost::alert {

/// mm between look-ups of the floor along a line: no more than the corner of a cell is missed.
inline constexpr std::int32_t kFloorStep = recon::guard::kFloorCell * 3 / 2;
/// mm before a thing that need not have been seen: its foot hides the floor there.
inline constexpr std::int32_t kHiddenFloor = 200;
/// mm around the robot's body that need not have been seen.
inline constexpr std::int32_t kBesideBody = 100;
/// m, half the distance between two points of a front, and some of their noise.
inline constexpr float kFrontRadius = 0.05F;
/// m. A longer side of an outline is cut into pieces of this length.
inline constexpr float kPiece = 0.1F;
/// No side has more pieces: it is 3 m long then.
inline constexpr int kMaxPieces = 31;
/// sigmas by which what is known badly is nearer.
inline constexpr float kNearer = 2.0F;

constexpr float metres(std::int32_t millimetres) { return 0.001F * static_cast<float>(millimetres); }

/// m, maximum distance of known floor; no way is followed farther.
inline constexpr float kFarthestKnown = metres(recon::guard::kFloorReach);

/// Sides of an outline from one that is looked at to the next: every fourth is enough.
inline constexpr std::size_t kSidesApart = 4;

/// The number of pieces that a side of this length (m) is cut into.
inline int pieces_of(float length) { return 1 + std::min(kMaxPieces, static_cast<int>(length / kPiece)); }

/// m. No point of the outline is farther from its middle: the farthest is where two of the sides meet.
inline float reach_of(const recon::OutlineView& outline) {
  const std::size_t sides = outline.offsets.size();
  std::int16_t most = 0;
  for (std::size_t k = 0; k < sides; k += kSidesApart) most = std::max(most, outline.offsets[k]);
  // 1 / cos of half of the angle between them.
  const float farther = sides == recon::kDirections ? 1.019592F : 1.082392F;
  return recon::kOffsetStep * farther * static_cast<float>(most);
}

}  // namespace fencepost::alert
