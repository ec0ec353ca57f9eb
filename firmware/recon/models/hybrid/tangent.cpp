#include "firmware/recon/models/hybrid/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/tuning.hpp"

namespace fencepost::recon {
namespace {

// Width (m) of the seen part of an object that goes on so far that its nearest point may be beyond the image; else 0.
float width_of_part(const Sighting& sighting) {
  if (sighting.both_edges() || !sighting.rows_known || !(sighting.bottom.drop > 0)) return 0;
  const float along = sighting.axis.dot(sighting.center);
  const float slopes = cross(sighting.right.direction, sighting.left.direction) / std::max(along * along, 0.1F);
  const float width = slopes * sighting.lens_height / sighting.bottom.drop;
  return sighting.no_edge() || width > kGoesOn ? width : 0.0F;
}

void put(ViewTangents& view, ViewTangents::Which which, Tangent& place, const Tangent& tangent) {
  place = tangent;
  std::uint8_t& bits = tangent.lower_bound ? view.lower_bound : view.present;
  bits = static_cast<std::uint8_t>(bits | which);
}

}  // namespace

ViewTangents tangents_of(const Sighting& sighting, MapPoint origin, float distance, const MeasurementNoise& noise) {
  ViewTangents view;
  const auto sigma = [&](const Ray& ray) { return std::sqrt(edge_variance(sighting, ray, distance, noise)); };
  const Ray& left = sighting.left;
  const Ray& right = sighting.right;
  if (left.end != End::kOccluded) {
    put(view, ViewTangents::kLeft, view.left, {left_tangent(sighting, origin), sigma(left), left.end != End::kSeen});
  }
  if (right.end != End::kOccluded) {
    put(view, ViewTangents::kRight, view.right,
        {right_tangent(sighting, origin), sigma(right), right.end != End::kSeen});
  }
  const float part = width_of_part(sighting);
  const bool hidden = !is_edge(sighting.bottom.end) || part > 0;
  const RowDepth row = hidden ? farthest_row_depth(sighting, noise) : row_depth(sighting, noise);
  if (row.known) {
    const Vec2 normal = -sighting.axis;
    const float reach = normal.dot(sighting.lens_from(origin)) - row.depth;
    const float sigma_of_foot = std::sqrt(row.variance + kFootSetBack * kFootSetBack);
    put(view, ViewTangents::kFront, view.front, {{normal, reach}, sigma_of_foot, hidden});
    if (part > 0 && is_edge(sighting.bottom.end)) view.straight = sigma_of_foot + kTilt * part;
  }
  return view;
}

}  // namespace fencepost::recon
