#include "firmware/recon/models/height_band.hpp"

#include <algorithm>

#include "firmware/recon/models/hash.hpp"

namespace fencepost::recon {
namespace {

// Sums are halved beyond this many views: they stay exact in float and follow slow change.
constexpr float kMaxBandViews = 256;

void add_row(HeightBand::Sums& sums, const Sighting& sighting, const Vec2& lens, float drop) {
  if (sums.views >= kMaxBandViews) {
    sums.slope *= 0.5F;
    sums.start *= 0.5F;
    sums.drop *= 0.5F;
    sums.height *= 0.5F;
    sums.views *= 0.5F;
  }
  sums.slope += drop * sighting.axis;
  sums.start += drop * lens.dot(sighting.axis);
  sums.drop += drop;
  sums.height += sighting.lens_height;
  sums.views += 1.0F;
}

float height_at(const HeightBand::Sums& sums, const Vec2& center, float radius) {
  const float fall = sums.slope.dot(center) - sums.start - radius * sums.drop;
  return (sums.height - fall) / sums.views;
}

}  // namespace

void HeightBand::add(const Sighting& sighting, MapPoint origin) {
  const Vec2 lens = sighting.lens_from(origin);
  if (is_edge(sighting.bottom.end)) add_row(bottom_, sighting, lens, sighting.bottom.drop);
  if (is_edge(sighting.top.end)) add_row(top_, sighting, lens, sighting.top.drop);
}

void HeightBand::move_origin(const Vec2& shift) {
  bottom_.start -= bottom_.slope.dot(shift);
  top_.start -= top_.slope.dot(shift);
}

HeightRange HeightBand::at(const Vec2& center, float radius) const {
  HeightRange range;
  range.bottom_known = bottom_.views > 0;
  range.top_known = top_.views > 0;
  // Nothing reaches below the floor; an unseen bottom stands on it.
  if (range.bottom_known) range.z_min = std::max(0.0F, height_at(bottom_, center, radius));
  range.z_max = range.top_known ? std::max(range.z_min, height_at(top_, center, radius)) : range.z_min;
  return range;
}

void HeightBand::hash(base::Fnv1a64& hash) const {
  for (const Sums& sums : {bottom_, top_}) {
    hash_vec(hash, sums.slope);
    for (const float value : {sums.start, sums.drop, sums.height, sums.views}) hash.f32(value);
  }
}

}  // namespace fencepost::recon
