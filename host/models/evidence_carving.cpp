#include "host/models/evidence_carving.hpp"

#include <cmath>

#include "hal/base/trig.hpp"

namespace fencepost::host {

Evidence::Evidence(const recon::HybridCore& hybrid, const recon::OutlineView& outline, recon::MapPoint origin)
    : known_(hybrid.refusal == recon::HybridRefusal::kNone),
      outline_(outline),
      middle_(recon::offset_from(origin, hybrid.origin)) {}

bool Evidence::contradicts(const recon::HalfPlane& tangent) const {
  if (!known_) return false;
  const std::size_t sectors = outline_.offsets.size();
  const recon::SectorPlace place = recon::place_of(tangent.normal, sectors);
  const std::size_t next = place.sector + 1 == sectors ? 0 : place.sector + 1;
  // Between two directions the outline has a corner: recon::SupportFit.
  const float step = 2 * base::kPi / static_cast<float>(sectors);
  const float angle = place.phase * step;
  const float first = std::sin(step - angle) / std::sin(step);
  const float second = std::sin(angle) / std::sin(step);
  const float reach = first * outline_.offset(place.sector) + second * outline_.offset(next);
  const float sigma = (1 - place.phase) * outline_.sigma(place.sector) + place.phase * outline_.sigma(next);
  return recon::seen_from(tangent, middle_).bound < reach - kContradictedSigmas * sigma;
}

Carved carve_with(std::span<const recon::HalfPlane> tangents, const Evidence& evidence) {
  Carved carved;
  carved.clip.start();
  carved.grid.start();
  for (const recon::HalfPlane& tangent : tangents) {
    if (evidence.contradicts(tangent)) continue;
    carved.clip.cut(tangent);
    carved.grid.carve(tangent);
    carved.grid.refine(carved.clip.vertices());
  }
  return carved;
}

}  // namespace fencepost::host
