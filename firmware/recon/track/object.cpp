#include "firmware/recon/track/object.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hash.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {

float ObjectCore::confidence() const {
  constexpr float kUnit = 1.0F / kConfidenceSteps;
  if (outline_confidence != kNoOutline) return static_cast<float>(outline_confidence) * kUnit * presence;
  const CylinderEstimate& estimate = cylinder.estimate();
  if (!estimate.ok()) return 0;
  const float uncertainty = std::sqrt(std::min(1.0F, estimate.outline_sigma() / estimate.radius));
  return (1.0F - uncertainty) * presence;
}

float ObjectCore::novelty(const Vec2& lens) const {
  const Vec2 center = cylinder.estimate().ok() ? cylinder.estimate().center : Vec2{0, 0};
  const float distance = std::max(kNearestLens, (center - lens).norm());
  const float moved_by = (lens - last_lens).norm();
  return std::clamp(moved_by / (kNovelShare * distance), kMinNovelty, 1.0F);
}

bool stand_in_one_place(const ObjectCore& a, const ObjectCore& b) {
  const CylinderEstimate& one = a.cylinder.estimate();
  const CylinderEstimate& other = b.cylinder.estimate();
  if (!one.ok() || !other.ok()) return false;
  const float larger = std::max(one.radius, other.radius);
  const float reach = larger + std::min(larger, one.outline_sigma() + other.outline_sigma());
  const Vec2 apart = offset_from(a.origin, b.origin) + other.center - one.center;
  return apart.squared_norm() < reach * reach;
}

void ObjectCore::hash(base::Fnv1a64& hash) const {
  hash.u32(id);
  hash.u8(signature);
  hash.u8(confirmed ? 1 : 0);
  hash.u8(clear ? 1 : 0);
  hash.u8(moving ? 1 : 0);
  hash.u8(static_cast<std::uint8_t>(left));
  hash.u8(static_cast<std::uint8_t>(right));
  hash.u8(relocations);
  hash.u8(in_pieces);
  hash.u8(static_cast<std::uint8_t>(left_off));
  hash.u8(static_cast<std::uint8_t>(right_off));
  hash.u16(static_cast<std::uint16_t>(foot_row));
  if (last_track != 0) hash.u8(last_track);
  hash.u32(views);
  hash.i64(last_seen.raw);
  hash.u16(history.bits);
  hash.u8(history.length);
  hash.u16(missed_for);
  hash.u8(waiting);
  hash.u8(outline_confidence);
  hash.f32(presence);
  hash.i32(origin.x);
  hash.i32(origin.y);
  hash_vec(hash, last_lens);
  hash_vec(hash, last_bearing);
  cylinder.hash(hash);
  band.hash(hash);
}

}  // namespace fencepost::recon
