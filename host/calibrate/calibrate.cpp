#include "host/calibrate/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/calibrate/findings.hpp"
#include "host/calibrate/fit.hpp"
#include "host/calibrate/known.hpp"
#include "host/calibrate/outline.hpp"
#include "host/calibrate/pads.hpp"
#include "host/calibrate/start.hpp"

namespace fencepost::host {
namespace {

/// Why the solver failed, as a sentence for whoever drives.
std::string no_fit(const std::string& reason) {
  return fmt::format("no calibration fits this log ({}); are camera and wheels of one robot, and its $FPCAM near? {}",
                     reason, kGuide);
}

std::array<bool, kCalibrated> hold(const std::array<bool, kCalibrated>& held, SolverOptions& options,
                                   StartedProblem& started) {
  for (std::size_t i = 0; i < kCameraParameters; ++i) {
    options.hold_camera[i] = held[i];
    if (held[i]) started.estimate.camera[i] = started.problem.configured[i];
  }
  for (std::size_t i = 0; i < kWheelParameters; ++i) {
    options.hold_wheels[i] = held[kCameraParameters + i];
    if (options.hold_wheels[i]) started.estimate.wheels[i] = 0;
  }
  return held;
}

/// Frees the lens's k1 only if the log shows, by kSure, that the configured value is wrong. Otherwise noise in k1 would
/// shift the focal length. Chosen on seeds 1 to 16 of the study.
void free_lens(StartedProblem& started, SolverOptions& options, std::optional<CalibratedMatrix>& matrix) {
  constexpr double kSure = 4;  // sigmas
  StartedProblem freed = started;
  SolverOptions free = options;
  free.hold_camera[kK1] = false;
  if (solve(freed.problem, free, freed.estimate)) return;
  const std::optional<CalibratedMatrix> variances = covariance_at(freed.problem, free, freed.estimate);
  if (!variances) return;
  const double off = freed.estimate.camera[kK1] - freed.problem.configured[kK1];
  if (std::abs(off) < kSure * std::sqrt((*variances)[kK1][kK1])) return;
  adopt(std::move(freed), std::move(free), started, options, matrix);
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

/// The sightings' residuals with poses and calibration as configured, each object where it fits best.
std::vector<SightingResidual> as_configured(const StartedProblem& started, Estimate configured) {
  configured.objects = started.estimate.objects;
  CalibrationProblem problem = started.problem;
  problem.noise = noise_of(residuals_at(problem, configured));
  static_cast<void>(solve(problem, only_objects(), configured));
  return residuals_at(problem, configured);
}

Calibration conclude(const DriveLog& log, const StartedProblem& started, const Estimate& configured,
                     const SolverOptions& options, const CalibratedMatrix& matrix,
                     const std::array<bool, kCalibrated>& held) {
  const CalibrationProblem& problem = started.problem;
  Calibration calibration;
  calibration.frames = started.frames;
  calibration.seconds = problem.odometry.end() - problem.odometry.begin();
  calibration.driven = problem.odometry.driven();
  calibration.turned = problem.odometry.turned();
  calibration.findings = findings_of(problem, started.estimate, matrix, held);
  calibration.configured = log.camera;
  calibration.found = calibrated(log.camera, started.estimate, held);
  calibration.pads = pads_of(started, options, matrix, log.signatures);
  calibration.signatures = with_pads(log.signatures, calibration.pads);
  const WheelValues& wheels = started.estimate.wheels;
  calibration.wheels = {wheels[kStep], wheels[kTurn], wheels[kCurve]};
  const std::vector<SightingResidual> before = as_configured(started, configured);
  const std::vector<SightingResidual> after = residuals_at(problem, started.estimate);
  calibration.before = summarise_residuals(problem, before, problem.optics.fx);
  calibration.after = summarise_residuals(problem, after, calibration.found.fx.to_double());
  calibration.way_before = way_of(configured);
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
  // Steps of about equal length: reading, the start, each round, what the log determines, the solution with it.
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
  const Estimate configured = started.estimate;
  SolverOptions all = possible(started.problem);
  all.hold_camera[kK1] = true;
  if (const auto failed = fit(started, all, step_done)) return refuse(no_fit(*failed));
  if (const auto why = too_few(started.estimate.objects.size())) return refuse(*why);
  std::optional<CalibratedMatrix> matrix = covariance_at(started.problem, all, started.estimate);
  free_pads(started, all, matrix);
  free_lens(started, all, matrix);
  if (!matrix) return refuse(fmt::format("what it shows leaves the calibration open; {}", kGuide));
  step_done();
  widen(*matrix);
  SolverOptions observed = all;
  const auto held = hold(to_be_held(started.problem, all, *matrix), observed, started);
  if (const auto failed = solve(started.problem, observed, started.estimate)) return refuse(no_fit(*failed));
  outcome.calibration = conclude(log, started, configured, observed, *matrix, held);
  const auto& findings = outcome.calibration->findings;
  if (std::ranges::none_of(findings, [](const Finding& f) { return f.essential && f.observed; })) {
    outcome.calibration.reset();
    return refuse(fmt::format("it tells neither focal length nor yaw, pitch or latency; {}", kGuide));
  }
  return outcome;
}

}  // namespace fencepost::host
