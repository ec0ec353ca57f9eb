#include "firmware/recon/hybrid/tangent.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

// A segment loses a piece of about this share of its width with this probability: what a first view must reckon with.
constexpr float kLostShare = 0.3F;
constexpr float kLossProbability = 0.05F;

// Variance (m^2) that a piece which may be lost adds to each edge of an object at `distance`.
float loss_variance(const Sighting& sighting, float distance) {
  if (sighting.left.censored || sighting.right.censored) return 0;
  const float width = std::sqrt((sighting.left.direction - sighting.right.direction).squaredNorm()) * distance;
  return kLossProbability * kLostShare * kLostShare * width * width;
}

}  // namespace

ViewTangents tangents_of(const Sighting& sighting, MapPoint origin, float distance, bool first_views,
                         const MeasurementNoise& noise) {
  ViewTangents view;
  const float extra = first_views ? loss_variance(sighting, distance) : 0.0F;
  const auto sigma = [&](const MapRay& ray) {
    return std::sqrt(edge_variance(sighting, ray, distance, noise) + extra);
  };
  if (!sighting.left.censored) {
    view.left = {left_tangent(sighting, origin), sigma(sighting.left)};
    view.present |= ViewTangents::kLeft;
  }
  if (!sighting.right.censored) {
    view.right = {right_tangent(sighting, origin), sigma(sighting.right)};
    view.present |= ViewTangents::kRight;
  }
  const RowDepth row = row_depth(sighting, noise);
  if (row.known) {
    const Vec2 normal = -sighting.axis;
    view.front = {{normal, normal.dot(sighting.lens_from(origin)) - row.depth}, std::sqrt(row.variance)};
    view.present |= ViewTangents::kFront;
  }
  return view;
}

}  // namespace fencepost::recon
