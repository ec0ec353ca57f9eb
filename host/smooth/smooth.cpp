#include "host/smooth/smooth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "host/calibrate/findings.hpp"
#include "host/smooth/association.hpp"
#include "host/smooth/noise_estimate.hpp"
#include "host/smooth/optimum.hpp"

namespace fencepost::host {
namespace {

constexpr int kRounds = 6;
constexpr std::size_t kMinViews = 4;  ///< two bearings place an object, more show whether it is one

SolverOptions all_held() {
  SolverOptions options;
  options.hold_camera.fill(true);
  options.hold_wheels.fill(true);
  return options;
}

/// Estimates poses, objects and the wheels' systematic errors. Rows of feet fix the unit of length by the lens's
/// height, unless the camera is estimated. Else the unit is the odometry's metre.
SolverOptions wanted(const CalibrationProblem& problem, bool calibrate) {
  SolverOptions options;
  options.hold_camera.fill(!calibrate);
  options.hold_camera[kK1] = true;
  if (!problem.rows) options.hold_camera[kPitch] = options.hold_camera[kHeight] = true;
  options.hold_wheels[kStep] = calibrate || !problem.rows;
  return options;
}

struct Attempt {
  StartedProblem started;
  std::size_t joined = 0;
  std::size_t left_out = 0;
  Reassigned boxes;
  double edges_before = 0;  ///< px
  std::string failure;
};

double edges_px(const StartedProblem& started) {
  const auto residuals = residuals_at(started.problem, started.estimate);
  return summarise_residuals(started.problem, residuals, started.problem.optics.fx).columns_px;
}

void add(const Reassigned& more, Reassigned& sum) {
  sum.added += more.added;
  sum.moved += more.moved;
  sum.taken_back += more.taken_back;
}

/// Solves, and in between measures noise and drift and asks again which box is of which object.
void fit(Attempt& attempt, const SolverOptions& options, int rounds, const std::function<void()>& round_done) {
  constexpr int kRound = 4;     // of these, with round objects: else a wrong place hides in a shape
  constexpr int kQuickly = 20;  // iterations of a round that is not the last
  constexpr double kFirstDrift = 8;
  constexpr double kFirstWalk = 4;
  StartedProblem& started = attempt.started;
  SolverOptions objects = all_held();
  objects.hold_shape = objects.hold_way = true;
  const auto failed = [&](const SolverOptions& how) {
    if (const auto why = solve(started.problem, how, started.estimate)) attempt.failure = *why;
    return !attempt.failure.empty();
  };
  if (failed(objects)) return;
  attempt.edges_before = edges_px(started);
  started.problem.drift = kFirstDrift;
  started.problem.walk = kFirstWalk;
  SolverOptions now = options;
  for (int round = 0; round < rounds; ++round) {
    now.hold_shape = round < kRound;
    now.iterations = round + 1 < kRounds ? kQuickly : options.iterations;
    if (failed(now)) return;
    started.problem.noise = image_noise(started.problem, started.estimate);
    const Strays strays = strays_of(started.problem, started.estimate);
    started.problem.drift = strays.drift;
    started.problem.walk = strays.walk;
    round_done();
    if (round == 0 || round + 1 == kRounds) continue;
    attempt.joined += join_by_test(started, now);
    if (round > 1) attempt.left_out += drop_lost(started, kMinViews);
    add(reassign(started), attempt.boxes);
    if (started.estimate.objects.empty()) return;
  }
}

Attempt attempt_from(const DriveLog& log, const ReplayOutcome& replayed) {
  constexpr std::size_t kMaxFrames = 6000;
  constexpr double kMaxNodes = 4000;
  return {start_with(log, {kMaxFrames, kMaxNodes, kMinViews, true}, replayed.result.path), 0, 0, {}, 0, {}};
}

/// Decides by one rough solution: without correction, the odometry strays so far that objects are not recognised again.
bool strays_too_far(Attempt attempt, const SolverOptions& options) {
  constexpr double kTooFar = 3;
  if (attempt.started.estimate.objects.empty()) return true;
  fit(attempt, options, 1, [] {});
  return !attempt.failure.empty() || attempt.started.problem.drift > kTooFar;
}

/// Holds what the log does not determine at the configured value, as calibrate does it.
void add_findings(StartedProblem& started, SolverOptions options, Smoothed& smoothed) {
  const std::optional<CalibratedMatrix> matrix = covariance_at(started.problem, options, started.estimate);
  if (!matrix) {
    smoothed.notes.emplace_back("what this log shows leaves the calibration open, so it is given without variances");
    return;
  }
  const auto held = to_be_held(started.problem, options, *matrix);
  smoothed.findings = findings_of(started.problem, started.estimate, *matrix, held);
  smoothed.camera = calibrated(smoothed.camera, started.estimate, held);
}

Smoothed conclude(const DriveLog& log, ResultDocument online, Attempt& attempt, bool calibrate) {
  StartedProblem& started = attempt.started;
  const CalibrationProblem& problem = started.problem;
  Smoothed smoothed;
  smoothed.camera = log.camera;
  const SolverOptions options = wanted(problem, calibrate);
  if (calibrate) add_findings(started, options, smoothed);
  smoothed.online = std::move(online);
  smoothed.frames = started.frames;
  smoothed.poses = started.estimate.nodes.size();
  smoothed.sightings = problem.sightings.size();
  smoothed.joined = attempt.joined;
  smoothed.left_out = attempt.left_out;
  smoothed.added = attempt.boxes.added;
  smoothed.taken_back = attempt.boxes.taken_back;
  smoothed.seconds = problem.odometry.end() - problem.odometry.begin();
  smoothed.driven = problem.odometry.driven();
  smoothed.turned = problem.odometry.turned();
  smoothed.drift = problem.drift;
  smoothed.walk = problem.walk;
  smoothed.edges_before = attempt.edges_before;
  smoothed.edges_after = edges_px(started);
  smoothed.objects = optimum_objects(started, options);
  smoothed.optimum = optimum_result(smoothed.online, log, started, smoothed.objects);
  smoothed.par = compare_online(smoothed.online, smoothed.optimum);
  if (log.camera_changed) {
    smoothed.notes.emplace_back("the calibration ($FPCAM) changes in the log: only frames of the last one are used");
  }
  return smoothed;
}

/// The start by a corrected path, whatever the log was recorded with: objects seen again are then known again.
ReplayOptions corrected_replay(ReplayOptions options) {
  options.settings = {{"correct.pose", "on"}, {"correct.drift", "15"}};
  return options;
}

bool by_odometry_alone(const DriveLog& log, const std::vector<PoseResult>& path) {
  return std::ranges::equal(log.odometry, path, [](const TimedPose& p, const PoseResult& q) {
    return p.x == q.x && p.y == q.y && p.heading == q.heading;
  });
}

}  // namespace

SmoothOutcome smooth(std::string_view bytes, const std::string& name, const SmoothOptions& options) {
  // Steps of about equal length: reading, whether to read again, each round, the objects in the end.
  constexpr double kSteps = 2 + kRounds + 1;
  double steps = 0;
  const auto step_done = [&] {
    if (options.progress) options.progress(++steps / kSteps);
  };
  SmoothOutcome outcome;
  ReplayOptions replay_options;
  replay_options.profile = options.profile.empty() ? "full" : options.profile;
  replay_options.camera = options.camera;
  replay_options.from = options.from;
  replay_options.to = options.to;
  const DriveLog log = read_drive(bytes, name, replay_options, outcome.replay);
  if (outcome.replay.unreadable) return outcome;
  step_done();
  if (log.odometry.size() < 2) {
    outcome.refusal = name +
                      ": there is no odometry to speak of, so there is no path to smooth; record $FPODO, too, or "
                      "$FPCAR with car.counts set";
    return outcome;
  }
  Attempt best = attempt_from(log, outcome.replay);
  const SolverOptions how = wanted(best.started.problem, options.calibrate);
  if (by_odometry_alone(log, outcome.replay.result.path) && strays_too_far(best, how)) {
    ReplayOutcome corrected;
    const DriveLog again = read_drive(bytes, name, corrected_replay(replay_options), corrected);
    if (!corrected.unreadable) {
      Attempt other = attempt_from(again, corrected);
      if (!other.started.estimate.objects.empty()) best = std::move(other);
    }
  }
  step_done();
  if (!best.started.estimate.objects.empty()) fit(best, how, kRounds, step_done);
  if (best.started.estimate.objects.empty()) {
    outcome.refusal = fmt::format(
        "{}: no object was seen in {} frames or more with an end inside the image; drive where some are in view for "
        "longer",
        name, kMinViews);
    return outcome;
  }
  if (!best.failure.empty()) {
    outcome.refusal = fmt::format(
        "{}: no path fits this log ({}); are camera and odometry of one robot, and its $FPCAM near? try calibrate",
        name, best.failure);
    return outcome;
  }
  outcome.smoothed = conclude(log, outcome.replay.result, best, options.calibrate);
  return outcome;
}

}  // namespace fencepost::host
