#include "host/calibrate/fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "host/calibrate/drift_model.hpp"
#include "host/calibrate/regroup.hpp"
#include "host/calibrate/residuals.hpp"
#include "host/calibrate/sighting_model.hpp"

namespace fencepost::host {
namespace {

/// How much more the odometry strays than good wheels do: by what the nodes' motions needed.
double drift_of(const CalibrationProblem& problem, const Estimate& estimate) {
  std::vector<double> needed;
  for (std::size_t i = 0; i + 1 < problem.node_times.size(); ++i) {
    const TrackPose a = problem.odometry.at(problem.node_times[i]);
    const TrackPose b = problem.odometry.at(problem.node_times[i + 1]);
    const auto motion = calibration::corrected(calibration::motion_between(a, b), estimate.wheels.data());
    const auto expected = calibration::after(estimate.nodes[i].data(), motion);
    const double sigma =
        std::hypot(calibration::stray(a, b, 1, 1).heading, std::sqrt(2.0) * problem.odometry.white().heading);
    needed.push_back(std::abs(estimate.nodes[i + 1][kPoseHeading] - expected.heading) / sigma);
  }
  constexpr double kSigmaOfMedian = 1.4826;
  constexpr double kMax = 30;
  return std::clamp(kSigmaOfMedian * median_of(std::move(needed)), 1.0, kMax);
}

}  // namespace

SolverOptions possible(const CalibrationProblem& problem) {
  SolverOptions options;
  options.hold_camera[kPitch] = options.hold_camera[kHeight] = !problem.rows;
  // Without a known length the odometry's metre is the unit.
  options.hold_wheels[kStep] = problem.sizes.empty() && problem.distances.empty();
  return options;
}

SolverOptions only_objects() {
  SolverOptions options;
  options.hold_shape = true;
  options.hold_camera.fill(true);
  options.hold_wheels.fill(true);
  options.hold_way = true;
  return options;
}

std::optional<std::string> fit(StartedProblem& started, const SolverOptions& options,
                               const std::function<void()>& round_done) {
  constexpr int kRound = 2;  // of these, with round objects: else a wrong distance hides in a shape
  SolverOptions now = options;
  for (int round = 0; round < kFitRounds; ++round) {
    now.hold_shape = round < kRound;
    if (auto failed = solve(started.problem, now, started.estimate)) return failed;
    if (round == 0) drop_unfit(started);
    if (round <= 1) join_same(started);
    if (round == kRound) drop_at_border(started);
    started.problem.noise = noise_of(residuals_at(started.problem, started.estimate));
    started.problem.drift = std::max(started.problem.drift, drift_of(started.problem, started.estimate));
    started.problem.walk = started.problem.drift;
    round_done();
  }
  return std::nullopt;
}

}  // namespace fencepost::host
