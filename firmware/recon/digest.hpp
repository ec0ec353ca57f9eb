// The state digest: FNV-1a 64 over an explicit little-endian serialisation, chained frame to frame. What is hashed is
// fixed by stream format 1 (host/share/doc/digest.md):
//   every frame: previous digest, frame number, exposure, pose, number of objects, next id;
//   each object seen in the frame: its core (identity, counters, origin, equations, estimate);
//   one slot in turn (frame count modulo capacity), if used: its core, sheaf, clip, grid and hybrid.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/recon/carve.hpp"
#include "firmware/recon/object.hpp"
#include "firmware/recon/pose_history.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

void hash_pose(base::Fnv1a64& hash, const MapPose& pose);
void hash_core(base::Fnv1a64& hash, const ObjectCore& object);
void hash_clip(base::Fnv1a64& hash, std::span<const Vec2> vertices);
void hash_grid(base::Fnv1a64& hash, const GridPlacement& placement, std::uint8_t placements,
               std::span<const std::uint32_t> words);
void hash_pending(base::Fnv1a64& hash, std::span<const HalfPlane> tangents);
void hash_sheaf(base::Fnv1a64& hash, std::span<const SheafView> views);
void hash_hybrid(base::Fnv1a64& hash, const HybridCore& core, ConstClusters clusters, const OutlineView& outline);

template <class Profile>
void hash_object(base::Fnv1a64& hash, const Object<Profile>& object) {
  hash_core(hash, object);
  hash_pending(hash, object.pending.view());
  if constexpr (Profile::kSheafViews > 0) hash_sheaf(hash, object.sheaf.view());
  hash_clip(hash, object.clip.vertices());
  hash_grid(hash, object.grid.placement(), object.grid.placements(), object.grid.words());
  hash_hybrid(hash, object.hybrid, object.hybrid.clusters, object.hybrid.outline());
}

}  // namespace fencepost::recon
