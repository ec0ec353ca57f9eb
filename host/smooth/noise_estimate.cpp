#include "host/smooth/noise_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/calibrate/drift_model.hpp"
#include "host/calibrate/sighting_model.hpp"
#include "host/geometry/median.hpp"

namespace fencepost::host {
namespace {

constexpr double kSigmaOfMedian = 1.4826;

struct Differences {
  std::vector<double> middles;
  std::vector<double> widths;
};

Differences differences_of(const CalibrationProblem& problem, const Estimate& estimate) {
  constexpr double kSoon = 0.8;  // s: odometry hardly strays meanwhile
  std::vector<const Sighting*> last(estimate.objects.size());
  Differences differences;
  for (const Sighting& sighting : problem.sightings) {
    if (!sighting.left || !sighting.right) continue;
    const Sighting* before = std::exchange(last[sighting.object], &sighting);
    if (before == nullptr || sighting.t - before->t > kSoon) continue;
    Sighting from_there = sighting;
    from_there.node = before->node;
    const SightingResidual a = residual_of(problem, estimate, *before);
    const SightingResidual b = residual_of(problem, estimate, from_there);
    differences.middles.push_back(std::abs(0.5 * (*b.left + *b.right - *a.left - *a.right)));
    differences.widths.push_back(std::abs(*b.right - *b.left - *a.right + *a.left));
  }
  return differences;
}

double sigma_of_differences(std::vector<double> magnitudes) {
  return kSigmaOfMedian * median_of(std::move(magnitudes)) / std::sqrt(2.0);
}

}  // namespace

ImageNoise image_noise(const CalibrationProblem& problem, const Estimate& estimate) {
  ImageNoise noise = noise_of(residuals_at(problem, estimate));
  Differences differences = differences_of(problem, estimate);
  noise.middle = std::max(noise.middle, sigma_of_differences(std::move(differences.middles)));
  noise.width = std::max(noise.width, sigma_of_differences(std::move(differences.widths)));
  noise.edge = std::max(noise.edge, std::hypot(noise.middle, noise.width / 2));
  return noise;
}

namespace {

/// Differences between the estimate and the odometry in way and turn over `baseline` s: the medians, in units of good
/// wheels.
Strays strays_over(double baseline, const CalibrationProblem& problem, const Estimate& estimate) {
  const std::vector<double>& times = problem.node_times;
  std::vector<double> turns;
  std::vector<double> ways;
  std::size_t j = 0;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    while (j + 1 < times.size() && (j <= i || times[j] < times[i] + baseline)) ++j;
    const TrackPose a = problem.odometry.at(times[i]);
    const TrackPose b = problem.odometry.at(times[j]);
    const auto motion = calibration::corrected(calibration::motion_between(a, b), estimate.wheels.data());
    const PoseNoise good = calibration::stray(a, b, 1, 1);
    const PoseNoise& white = problem.odometry.white();
    const PoseValues& from = estimate.nodes[i];
    const PoseValues& to = estimate.nodes[j];
    turns.push_back(std::abs(to[kPoseHeading] - from[kPoseHeading] - motion.turn) /
                    std::hypot(good.heading, std::sqrt(2.0) * white.heading));
    // The chord: a wrong heading turns it and leaves it as long.
    const double chord = std::hypot(to[kPoseX] - from[kPoseX], to[kPoseY] - from[kPoseY]);
    ways.push_back(std::abs(chord - std::hypot(motion.ahead, motion.left)) /
                   std::hypot(good.position, std::sqrt(2.0) * white.position));
  }
  constexpr double kMin = 0.25;
  constexpr double kMax = 60;
  const auto factor = [&](std::vector<double> needed) {
    return std::clamp(kSigmaOfMedian * median_of(std::move(needed)), kMin, kMax);
  };
  return {factor(std::move(turns)), factor(std::move(ways))};
}

}  // namespace

Strays strays_of(const CalibrationProblem& problem, const Estimate& estimate) {
  constexpr double kBaseline = 4;      // s
  constexpr double kShareOfLog = 0.1;  // at most, of a short one
  // A map that shrinks needs ways that stray, and ways that may stray shrink the map: it would run away.
  constexpr double kMaxWalk = 4;
  const std::vector<double>& times = problem.node_times;
  if (times.size() < 3) return {1, 1};
  Strays strays = strays_over(std::min(kBaseline, kShareOfLog * (times.back() - times.front())), problem, estimate);
  strays.walk = std::min(strays.walk, kMaxWalk);
  return strays;
}

}  // namespace fencepost::host
