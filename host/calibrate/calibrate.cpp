#include "host/calibrate/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "host/calibrate/drift_model.hpp"
#include "host/calibrate/findings.hpp"
#include "host/calibrate/known.hpp"
#include "host/calibrate/outline.hpp"
#include "host/calibrate/regroup.hpp"
#include "host/calibrate/sighting_model.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {
namespace {

/// Residuals grow by what calibration a log was not told has not in its model: corners, shadows. Chosen on seeds of the
/// study (tests/studies/calibrate) that it does not use.
constexpr double kCaution = 1.15;

constexpr int kFitRounds = 5;

/// Why the solver failed, as a sentence for whoever drives.
std::string no_fit(const std::string& reason) {
  return fmt::format("no calibration fits this log ({}); are camera and wheels of one robot, and its $FPCAM near? {}",
                     reason, kGuide);
}

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
  constexpr double kMost = 30;
  return std::clamp(kSigmaOfMedian * median_of(std::move(needed)), 1.0, kMost);
}

/// What has to be held because nothing in the log is about it.
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

/// Solves with noise that is measured in between, and objects that turn out to be one joined.
std::optional<std::string> fit(StartedProblem& started, const SolverOptions& options,
                               const std::function<void()>& round_done) {
  constexpr int kRounds = kFitRounds;
  constexpr int kRound = 2;  // of these, with round objects: else a wrong distance hides in a shape
  SolverOptions now = options;
  for (int round = 0; round < kRounds; ++round) {
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

std::array<bool, kCalibrated> hold(const std::array<bool, kCalibrated>& held, SolverOptions& options,
                                   StartedProblem& started) {
  for (std::size_t i = 0; i < kCameraParameters; ++i) {
    options.hold_camera[i] = held[i];
    if (held[i]) started.estimate.camera[i] = started.problem.told[i];
  }
  for (std::size_t i = 0; i < kWheelParameters; ++i) {
    options.hold_wheels[i] = held[kCameraParameters + i];
    if (options.hold_wheels[i]) started.estimate.wheels[i] = 0;
  }
  return held;
}

/// A lens goes on having the distortion that it was told to have unless the log is sure that it does not: what noise
/// makes of k1 would otherwise be taken from the focal length. Chosen on seeds 1 to 16 of the study.
void free_lens(StartedProblem& started, SolverOptions& options, std::optional<CalibratedMatrix>& matrix) {
  constexpr double kSure = 4;  // sigmas
  StartedProblem freed = started;
  SolverOptions free = options;
  free.hold_camera[kK1] = false;
  if (solve(freed.problem, free, freed.estimate)) return;
  const std::optional<CalibratedMatrix> variances = covariance_at(freed.problem, free, freed.estimate);
  if (!variances) return;
  const double off = freed.estimate.camera[kK1] - freed.problem.told[kK1];
  if (std::abs(off) < kSure * std::sqrt((*variances)[kK1][kK1])) return;
  freed.problem.noise = noise_of(residuals_at(freed.problem, freed.estimate));
  if (solve(freed.problem, free, freed.estimate)) return;
  started = std::move(freed);
  options = free;
  matrix = covariance_at(started.problem, options, started.estimate);
}

std::vector<Point> way_of(const Estimate& estimate) {
  std::vector<Point> way;
  for (const PoseValues& node : estimate.nodes) way.push_back({node[kPoseX], node[kPoseY]});
  return way;
}

void add_objects(const StartedProblem& started, const std::vector<SightingResidual>& before,
                 const std::vector<SightingResidual>& after, Calibration& calibration) {
  for (std::size_t o = 0; o < started.estimate.objects.size(); ++o) {
    const ObjectValues& values = started.estimate.objects[o];
    CalibratedObject object;
    object.name = signature_name(calibration.signatures, started.signatures[o]);
    for (const record::Signature& signature : calibration.signatures) {
      if (signature.signature == started.signatures[o]) object.rgb = signature.rgb;
    }
    object.centre = {values[kCentreX], values[kCentreY]};
    object.outline = outline_of(values);
    for (std::size_t i = 0; i < started.problem.sightings.size(); ++i) {
      if (started.problem.sightings[i].object != o) continue;
      if (before[i].floor) object.feet_before.push_back(*before[i].floor);
      if (after[i].floor) object.feet_after.push_back(*after[i].floor);
    }
    calibration.objects.push_back(std::move(object));
  }
}

/// The sightings with poses and calibration as told, each object where it fits best.
std::vector<SightingResidual> as_told(const StartedProblem& started, Estimate told) {
  told.objects = started.estimate.objects;
  CalibrationProblem problem = started.problem;
  problem.noise = noise_of(residuals_at(problem, told));
  static_cast<void>(solve(problem, only_objects(), told));
  return residuals_at(problem, told);
}

Calibration conclude(const DriveLog& log, const StartedProblem& started, const Estimate& told,
                     const CalibratedMatrix& matrix, const std::array<bool, kCalibrated>& held) {
  const CalibrationProblem& problem = started.problem;
  Calibration calibration;
  calibration.frames = started.frames;
  calibration.seconds = problem.odometry.end() - problem.odometry.begin();
  calibration.driven = problem.odometry.driven();
  calibration.turned = problem.odometry.turned();
  calibration.findings = findings_of(problem, started.estimate, matrix, held);
  calibration.told = log.camera;
  calibration.found = calibrated(log.camera, started.estimate, held);
  calibration.signatures = log.signatures;
  const WheelValues& wheels = started.estimate.wheels;
  calibration.wheels = {wheels[kStep], wheels[kTurn], wheels[kCurve]};
  const std::vector<SightingResidual> before = as_told(started, told);
  const std::vector<SightingResidual> after = residuals_at(problem, started.estimate);
  calibration.before = summarise_residuals(problem, before, problem.optics.fx);
  calibration.after = summarise_residuals(problem, after, calibration.found.fx.to_double());
  calibration.way_before = way_of(told);
  calibration.way_after = way_of(started.estimate);
  add_objects(started, before, after, calibration);
  if (log.camera_changed) {
    calibration.notes.emplace_back("the calibration ($FPCAM) changes in the log: only frames of the last one are used");
  }
  if (started.estimate.camera[kLatency] < 0 && !held[kLatency]) {
    calibration.notes.emplace_back("the latency came out below 0, which cannot be, and is written as 0");
  }
  return calibration;
}

void widen(CalibratedMatrix& matrix) {
  for (auto& row : matrix) {
    for (double& value : row) value *= kCaution * kCaution;
  }
}

}  // namespace

bool Calibration::complete() const {
  return std::ranges::all_of(findings, [](const Finding& finding) { return finding.observed || !finding.essential; });
}

CalibrateOutcome calibrate(std::string_view bytes, const std::string& name, const CalibrateOptions& options) {
  // Of about equal length: reading, the start, each round, what can be told, the solution with it.
  constexpr double kSteps = 2 + kFitRounds + 2;
  double steps = 0;
  const auto step_done = [&] {
    if (options.progress) options.progress(++steps / kSteps);
  };
  CalibrateOutcome outcome;
  ReplayOptions replay_options;
  replay_options.profile = "full";
  replay_options.camera = options.camera;
  replay_options.from = options.from;
  replay_options.to = options.to;
  const DriveLog log = read_drive(bytes, name, replay_options, outcome.replay);
  if (outcome.replay.unreadable) return outcome;
  step_done();
  const auto refuse = [&](const std::string& why) {
    outcome.refusal = name + ": " + why;
    return std::move(outcome);
  };

  std::variant<StartedProblem, std::string> start = start_problem(log);
  if (const auto* why = std::get_if<std::string>(&start)) return refuse(*why);
  StartedProblem& started = std::get<StartedProblem>(start);
  if (const auto why = add_known(options, log.signatures, started)) {
    outcome.usage = true;
    outcome.refusal = *why;
    return outcome;
  }
  if (const auto failed = solve(started.problem, only_objects(), started.estimate)) return refuse(no_fit(*failed));
  step_done();
  const Estimate told = started.estimate;
  SolverOptions all = possible(started.problem);
  all.hold_camera[kK1] = true;
  if (const auto failed = fit(started, all, step_done)) return refuse(no_fit(*failed));
  if (const auto why = too_few(started.estimate.objects.size())) return refuse(*why);
  std::optional<CalibratedMatrix> matrix = covariance_at(started.problem, all, started.estimate);
  free_lens(started, all, matrix);
  if (!matrix) return refuse(fmt::format("what it shows leaves the calibration open; {}", kGuide));
  step_done();
  widen(*matrix);
  SolverOptions observed = all;
  const auto held = hold(to_be_held(started.problem, all, *matrix), observed, started);
  if (const auto failed = solve(started.problem, observed, started.estimate)) return refuse(no_fit(*failed));
  outcome.calibration = conclude(log, started, told, *matrix, held);
  const auto& findings = outcome.calibration->findings;
  if (std::ranges::none_of(findings, [](const Finding& f) { return f.essential && f.observed; })) {
    outcome.calibration.reset();
    return refuse(fmt::format("it tells neither focal length nor yaw, pitch or latency; {}", kGuide));
  }
  return outcome;
}

}  // namespace fencepost::host
