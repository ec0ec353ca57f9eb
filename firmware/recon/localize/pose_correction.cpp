#include "firmware/recon/localize/pose_correction.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/models/hybrid/tangent.hpp"
#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {
namespace {

LandmarkGuess guess_of_cylinder(const ObjectCore& object, const Sighting& seen) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  LandmarkGuess guess;
  guess.away = offset_from(seen.anchor, object.origin) + estimate.center;
  guess.radius = std::min(estimate.radius, kLargestRadius);
  guess.covariance = estimate.covariance;
  guess.covariance.scale(kOverconfidence);
  // The filter is linear in the place: what bearings alone have placed begins when the range is known.
  const Vec2 range = guess.away - seen.lens;
  const float most = kMaxDistanceSigmaShare * range.squared_norm();
  if (seen.bearing && guess.covariance.position_along(range) > most * most) return {};
  return guess;
}

// Farther than the models take a row: its sigma grows with the square of the distance, and the filter weighs it so.
RowDepth foot_depth(const Sighting& seen, const MeasurementNoise& noise) {
  const float drop = seen.bottom.drop;
  if (!seen.rows_known || seen.no_edge() || !is_edge(seen.bottom.end)) return {};
  if (!(drop > 0)) return {};
  const float depth = seen.lens_height / drop;
  const float row = noise.row_px / seen.focal;
  const float angle2 = row * row + noise.pitch * noise.pitch;
  return {true, depth, depth * depth * angle2 / (drop * drop) + noise.position * noise.position};
}

/// The estimated distance of a circle, m.
struct RangeGuess {
  float distance = 0;
  float variance = 0;
  float with_radius = 0;  ///< covariance
};

// With a configured radius the half angle between both ends gives the range. A wrong heading does not change that.
RangeGuess range_of_width(const Sighting& seen, float half, const RadiusPrior& radius, MeasurementNoise noise) {
  noise.heading = 0;
  const float distance = radius.mean / half;
  const float of_radius = radius.sigma / half;
  const float of_angle = 0.5F * distance / half;
  const float ends = direction_variance(seen, seen.left, noise) + direction_variance(seen, seen.right, noise);
  return {distance, of_radius * of_radius + of_angle * of_angle * ends, of_radius * radius.sigma};
}

RangeGuess range_of_sighting(const Sighting& seen, float half, const MeasurementNoise& noise) {
  if (seen.known_radius > 0) return range_of_width(seen, half, radius_prior(seen.known_radius), noise);
  const RowDepth row = foot_depth(seen, noise);
  const float distance = row.known ? row.depth / seen.center.dot(seen.axis) + kTypicalRadius : kTypicalRadius / half;
  const float sigma = (row.known ? kMaxDistanceSigmaShare : kSizeShare) * distance;
  return {distance, sigma * sigma, 0};
}

LandmarkGuess guess_of_sighting(const Sighting& seen, const MeasurementNoise& noise) {
  if (!seen.both_edges()) return {};
  const RadiusPrior radius = radius_prior(seen.known_radius);
  const float half = 0.5F * (seen.left.direction - seen.right.direction).norm();
  if (!(half > 0)) return {};
  const RangeGuess range = range_of_sighting(seen, half, noise);
  LandmarkGuess guess;
  guess.away = seen.lens + range.distance * seen.center;
  guess.radius = radius.mean;
  const Vec2& u = seen.center;
  constexpr float kAcross2 = kAcross * kAcross;
  guess.covariance.xx = range.variance * u.x() * u.x() + kAcross2 * u.y() * u.y();
  guess.covariance.yy = range.variance * u.y() * u.y() + kAcross2 * u.x() * u.x();
  guess.covariance.xy = (range.variance - kAcross2) * u.x() * u.y();
  guess.covariance.xr = range.with_radius * u.x();
  guess.covariance.yr = range.with_radius * u.y();
  guess.covariance.rr = radius.sigma * radius.sigma;
  return guess;
}

using Line = SightedCircle::Line;
float squared(float value) { return value * value; }

// Combines both ends. A wrong heading shifts one outwards and the other inwards by the same amount. Half the sum of
// their equations is therefore free of the heading, and half the difference is free of the radius.
Line width_of(const ViewTangents& view, const Vec2& slope, float variance) {
  const HalfPlane& left = view.left.line;
  const HalfPlane& right = view.right.line;
  return {{0.5F * (left.normal + right.normal), 0.5F * (left.bound + right.bound), 1, slope}, variance};
}
Line middle_of(const ViewTangents& view, const Vec2& slope, float variance) {
  const HalfPlane& left = view.left.line;
  const HalfPlane& right = view.right.line;
  return {{0.5F * (left.normal - right.normal), 0.5F * (left.bound - right.bound), 0, slope}, variance};
}
Line tangent_of(const Tangent& tangent, const Vec2& slope, float variance) {
  return {{tangent.line.normal, tangent.line.bound, 1, slope}, squared(tangent.sigma) + variance};
}

// The equation of a foot's row. In a pinhole's image a row is a depth along the axis, whatever the column. Through an
// equidistant lens the lowest point of a foot is the nearest one on the ray to it.
Line foot_of(const Sighting& seen, float variance, const MeasurementNoise& noise) {
  const RowDepth foot = foot_depth(seen, noise);
  if (!foot.known) return {};
  if (!seen.equidistant) {
    const Vec2 normal = -seen.axis;
    return {{normal, normal.dot(seen.lens) - foot.depth, 1, normal}, foot.variance + variance};
  }
  const Vec2 normal = -seen.center;
  const float along = seen.center.dot(seen.axis);
  const float range = foot.depth / along;
  return {{normal, normal.dot(seen.lens) - range, 1, normal}, foot.variance / squared(squared(along)) + variance};
}

}  // namespace

SightedCircle sighted_circle(const Sighting& seen, const Vec2& away, float radius, float novelty,
                             const MeasurementNoise& noise) {
  SightedCircle circle;
  const float distance = away.norm();
  if (!(distance > 0)) return circle;
  MeasurementNoise ends = noise;  // of each end alone; the pose's is that of both
  ends.heading = 0;
  ends.position = 0;
  const ViewTangents view = tangents_of(seen, {}, distance, ends);
  const float shape = squared(noise.roundness * radius);
  const float place = squared(noise.position);
  const float pose = squared(noise.heading * distance) + place;
  // Half the sum and half the difference of the unit normals with which both ends should be seen.
  const float sine = std::min(kWidestSine, radius / distance);
  const Vec2 inwards = (-sine / distance) * away;
  const Vec2 across = (std::sqrt(1 - sine * sine) / distance) * left_of(away);
  constexpr unsigned kBoth = ViewTangents::kLeft | ViewTangents::kRight;
  if ((view.present & kBoth) == kBoth) {
    const float each = 0.25F * (squared(view.left.sigma) + squared(view.right.sigma)) + 0.5F * shape;
    circle.lines = {width_of(view, inwards, each), middle_of(view, across, each + pose)};
  } else if ((view.present & ViewTangents::kLeft) != 0) {
    circle.lines[0] = tangent_of(view.left, inwards + across, shape + pose);
  } else if ((view.present & ViewTangents::kRight) != 0) {
    circle.lines[0] = tangent_of(view.right, inwards - across, shape + pose);
  }
  if (seen.bearing) {
    const Vec2 normal = left_of(seen.center);
    const float sigma2 = edge_variance(bearing_variance(seen, ends), distance, ends);
    circle.lines[1] = {{normal, normal.dot(seen.lens), 0, across}, sigma2 + shape + pose};
  }
  circle.lines[2] = foot_of(seen, shape + place, noise);
  for (Line& line : circle.lines) line.variance /= novelty;
  return circle;
}

LandmarkGuess guess_of(const ObjectCore& object, const Sighting& seen, const MeasurementNoise& noise) {
  // Noisy directions have parallax to themselves, and draw towards the lens what only parallax has placed.
  // A bearing has nothing else.
  const bool placed = object.cylinder.estimate().ok() && (object.cylinder.row_count() > 0 || seen.bearing);
  LandmarkGuess guess = placed ? guess_of_cylinder(object, seen) : guess_of_sighting(seen, noise);
  const float shape = noise.roundness * guess.radius;
  guess.covariance.xx += shape * shape;
  guess.covariance.yy += shape * shape;
  if (!(seen.known_radius > 0)) guess.covariance.rr += shape * shape;
  return guess;
}

}  // namespace fencepost::recon
