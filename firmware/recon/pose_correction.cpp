#include "firmware/recon/pose_correction.hpp"

#include <algorithm>

namespace fencepost::recon {
namespace {

// The estimate took the same frames and the same poses for independent: its variances are too small by about this.
constexpr float kTooSure = 4.0F;
constexpr float kLargestRadius = 1.0F;  // m

}  // namespace

LandmarkGuess guess_of(const ObjectCore& object, MapPoint robot, const MeasurementNoise& noise) {
  const CylinderEstimate& estimate = object.cylinder.estimate();
  LandmarkGuess guess;
  guess.away = offset_from(robot, object.origin) + estimate.center;
  guess.radius = std::min(estimate.radius, kLargestRadius);
  guess.covariance = estimate.covariance;
  guess.covariance.scale(kTooSure);
  const float shape = noise.roundness * guess.radius;
  guess.covariance.xx += shape * shape;
  guess.covariance.yy += shape * shape;
  guess.covariance.rr += shape * shape;
  return guess;
}

MeasurementNoise without_pose(MeasurementNoise noise) {
  noise.heading = 0;
  noise.position = 0;
  return noise;
}

}  // namespace fencepost::recon
