#include "firmware/recon/models/hash.hpp"

namespace fencepost::recon {

void hash_vec(base::Fnv1a64& hash, const Vec2& v) {
  hash.f32(v.x());
  hash.f32(v.y());
}

void hash_points(base::Fnv1a64& hash, std::span<const Vec2> points) {
  hash.u16(static_cast<std::uint16_t>(points.size()));
  for (const Vec2& point : points) hash_vec(hash, point);
}

void hash_half_planes(base::Fnv1a64& hash, std::span<const HalfPlane> half_planes) {
  hash.u16(static_cast<std::uint16_t>(half_planes.size()));
  for (const HalfPlane& half_plane : half_planes) {
    hash_vec(hash, half_plane.normal);
    hash.f32(half_plane.bound);
  }
}

void hash_grid(base::Fnv1a64& hash, const GridPlacement& placement, std::uint8_t placements,
               std::span<const std::uint32_t> words) {
  hash_vec(hash, placement.low);
  hash.f32(placement.cell);
  hash.u8(placements);
  for (const std::uint32_t word : words) hash.u32(word);
}

}  // namespace fencepost::recon
