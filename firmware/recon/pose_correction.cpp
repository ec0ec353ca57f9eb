#include "firmware/recon/pose_correction.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::recon {
namespace {

// The estimate took the same frames and the same poses for independent: its variances are too small by about this.
constexpr float kTooSure = 4.0F;
constexpr float kLargestRadius = 1.0F;  // m

constexpr float kTypicalRadius = 0.08F;  // m
constexpr float kRadiusSigma = 0.05F;
// Of the distance by a typical size, and by the row: shares of it.
constexpr float kSizeShare = 0.5F;
constexpr float kRowShare = 0.25F;
constexpr float kFarthestGuess = 10.0F;  // m
constexpr float kAcross = 0.03F;         // m, beside the bearing

LandmarkGuess guess_of_cylinder(const ObjectCore& object, const Sighting& seen) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  LandmarkGuess guess;
  guess.away = offset_from(seen.anchor, object.origin) + estimate.center;
  guess.radius = std::min(estimate.radius, kLargestRadius);
  guess.covariance = estimate.covariance;
  guess.covariance.scale(kTooSure);
  return guess;
}

LandmarkGuess guess_of_sighting(const Sighting& seen, const MeasurementNoise& noise) {
  if (seen.left.censored || seen.right.censored) return {};
  const float half = 0.5F * std::sqrt((seen.left.direction - seen.right.direction).squaredNorm());
  if (!(half * kFarthestGuess > kTypicalRadius)) return {};
  const RowDepth row = row_depth(seen, noise);
  const float distance = row.known ? row.depth / seen.center.dot(seen.axis) + kTypicalRadius : kTypicalRadius / half;
  const float along = (row.known ? kRowShare : kSizeShare) * distance;
  LandmarkGuess guess;
  guess.away = seen.lens + distance * seen.center;
  guess.radius = kTypicalRadius;
  const Vec2& u = seen.center;
  constexpr float kAcross2 = kAcross * kAcross;
  guess.covariance.xx = along * along * u.x() * u.x() + kAcross2 * u.y() * u.y();
  guess.covariance.yy = along * along * u.y() * u.y() + kAcross2 * u.x() * u.x();
  guess.covariance.xy = (along * along - kAcross2) * u.x() * u.y();
  guess.covariance.rr = kRadiusSigma * kRadiusSigma;
  return guess;
}

}  // namespace

LandmarkGuess guess_of(const ObjectCore& object, const Sighting& seen, const MeasurementNoise& noise) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  LandmarkGuess guess = estimate.ok() ? guess_of_cylinder(object, seen) : guess_of_sighting(seen, noise);
  const float shape = noise.roundness * guess.radius;
  guess.covariance.xx += shape * shape;
  guess.covariance.yy += shape * shape;
  guess.covariance.rr += shape * shape;
  return guess;
}

}  // namespace fencepost::recon
