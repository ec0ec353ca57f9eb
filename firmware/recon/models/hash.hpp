// Geometry in the state digest (firmware/recon/DIGEST.md): field by field, floats by their bits.
#pragma once

#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/carve.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

void hash_vec(base::Fnv1a64& hash, const Vec2& v);
/// With their number.
void hash_points(base::Fnv1a64& hash, std::span<const Vec2> points);
void hash_half_planes(base::Fnv1a64& hash, std::span<const HalfPlane> half_planes);
void hash_grid(base::Fnv1a64& hash, const GridPlacement& placement, std::uint8_t placements,
               std::span<const std::uint32_t> words);

}  // namespace fencepost::recon
