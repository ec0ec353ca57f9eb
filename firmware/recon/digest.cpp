#include "firmware/recon/digest.hpp"

namespace fencepost::recon {
namespace {

void hash_vec(base::Fnv1a64& hash, const Vec2& v) {
  hash.f32(v.x());
  hash.f32(v.y());
}

void hash_symmetric(base::Fnv1a64& hash, const Symmetric3& m) {
  hash.f32(m.xx);
  hash.f32(m.xy);
  hash.f32(m.yy);
  hash.f32(m.xr);
  hash.f32(m.yr);
  hash.f32(m.rr);
}

void hash_equations(base::Fnv1a64& hash, const NormalEquations& equations) {
  hash_symmetric(hash, equations.information);
  hash_vec(hash, equations.moment);
  hash.f32(equations.moment_radius);
}

void hash_band(base::Fnv1a64& hash, const HeightBand::Sums& sums) {
  hash_vec(hash, sums.slope);
  hash.f32(sums.start);
  hash.f32(sums.drop);
  hash.f32(sums.height);
  hash.f32(sums.views);
}

}  // namespace

void hash_pose(base::Fnv1a64& hash, const MapPose& pose) {
  hash.i32(pose.position.x);
  hash.i32(pose.position.y);
  hash.i32(pose.heading);
}

void hash_sighted(base::Fnv1a64& hash, const ObjectCore& object) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  hash.u32(object.id);
  hash.u32(object.views);
  hash.u8(static_cast<std::uint8_t>(estimate.refusal));
  if (!estimate.ok()) return;
  hash_vec(hash, estimate.center);
  hash.f32(estimate.radius);
}

void hash_core(base::Fnv1a64& hash, const ObjectCore& object) {
  hash.u32(object.id);
  hash.u8(object.signature);
  hash.u8(object.confirmed ? 1 : 0);
  hash.u8(object.left_open ? 1 : 0);
  hash.u8(object.right_open ? 1 : 0);
  hash.u8(object.arenas);
  hash.u8(object.in_pieces);
  hash.u8(static_cast<std::uint8_t>(object.left_off));
  hash.u8(static_cast<std::uint8_t>(object.right_off));
  hash.u32(object.views);
  hash.i64(object.last_seen.raw);
  hash.u16(object.history.bits);
  hash.u8(object.history.length);
  hash.u16(object.missed_in_a_row);
  hash.u8(object.waiting);
  hash.u8(object.sureness);
  hash.f32(object.presence);
  hash.i32(object.origin.x);
  hash.i32(object.origin.y);
  hash_vec(hash, object.last_lens);
  hash_vec(hash, object.last_bearing);
  hash_equations(hash, object.cylinder.edges());
  hash_equations(hash, object.cylinder.rows());
  hash.f32(object.cylinder.row_count());
  hash.f32(object.cylinder.agreement());
  hash.f32(object.cylinder.false_depth());
  hash.u8(object.cylinder.first_views());
  hash.u8(object.cylinder.seen_whole() ? 1 : 0);
  const CylinderEstimate& estimate = object.cylinder.estimate();
  hash.u8(static_cast<std::uint8_t>(estimate.refusal));
  if (estimate.ok()) {
    hash_vec(hash, estimate.center);
    hash.f32(estimate.radius);
    hash_symmetric(hash, estimate.covariance);
  }
  hash_band(hash, object.band.bottom());
  hash_band(hash, object.band.top());
}

void hash_paper(base::Fnv1a64& hash, const CylinderPaper& paper) {
  const CylinderPaper::Sums& sums = paper.sums();
  hash.f32(sums.nxx);
  hash.f32(sums.nxy);
  hash.f32(sums.nyy);
  hash_vec(hash, sums.moment);
  hash_vec(hash, sums.reach);
  hash.f32(sums.start);
  hash.f32(sums.views);
}

void hash_clip(base::Fnv1a64& hash, std::span<const Vec2> vertices) {
  hash.u16(static_cast<std::uint16_t>(vertices.size()));
  for (const Vec2& vertex : vertices) hash_vec(hash, vertex);
}

void hash_grid(base::Fnv1a64& hash, const GridPlacement& placement, std::uint8_t placements,
               std::span<const std::uint32_t> words) {
  hash_vec(hash, placement.low);
  hash.f32(placement.cell);
  hash.u8(placements);
  for (const std::uint32_t word : words) hash.u32(word);
}

void hash_pending(base::Fnv1a64& hash, std::span<const HalfPlane> tangents) {
  hash.u16(static_cast<std::uint16_t>(tangents.size()));
  for (const HalfPlane& tangent : tangents) {
    hash_vec(hash, tangent.normal);
    hash.f32(tangent.bound);
  }
}

void hash_sheaf(base::Fnv1a64& hash, std::span<const SheafView> views) {
  hash.u16(static_cast<std::uint16_t>(views.size()));
  for (const SheafView& view : views) {
    hash_vec(hash, view.lens);
    hash_vec(hash, view.bearing);
    hash_vec(hash, view.left);
    hash_vec(hash, view.right);
  }
}

void hash_clusters(base::Fnv1a64& hash, ConstClusters clusters) {
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const PackedCluster& cluster = clusters[i];
    if (cluster.views == 0) continue;
    hash.u8(static_cast<std::uint8_t>(i));
    hash.u8(cluster.offset_low);
    hash.u8(cluster.offset_high);
    hash.u8(cluster.phase);
    hash.u8(cluster.sigma);
    hash.u8(cluster.views);
  }
}

void hash_outline(base::Fnv1a64& hash, const HybridCore& core, const OutlineView& outline) {
  hash.i32(core.origin.x);
  hash.i32(core.origin.y);
  hash_vec(hash, core.last_lens);
  hash.u8(core.views);
  hash.u8(core.used);
  hash.u8(core.spread);
  hash.u8(static_cast<std::uint8_t>(core.refusal));
  hash.u8(core.news ? 1 : 0);
  hash.u8(core.fitting ? 1 : 0);
  if (core.refusal != HybridRefusal::kNone) return;
  for (const std::int16_t offset : outline.offsets) hash.u16(static_cast<std::uint16_t>(offset));
  for (const std::uint8_t sigma : outline.sigmas) hash.u8(sigma);
}

void hash_floats(base::Fnv1a64& hash, std::span<const float> values) {
  for (const float value : values) hash.f32(value);
}

void hash_landmark(base::Fnv1a64& hash, const Landmark& landmark) {
  hash.i32(landmark.center.x);
  hash.i32(landmark.center.y);
  hash.f32(landmark.radius);
}

}  // namespace fencepost::recon
