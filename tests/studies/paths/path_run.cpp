#include "tests/studies/paths/path_run.hpp"

#include <stdexcept>

#include "host/evaluate/evaluate.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/common/noise_levels.hpp"
#include "tests/studies/drift/drifting_odometry.hpp"
#include "tests/studies/tables/given_run.hpp"
#include "tests/studies/tables/tour.hpp"

namespace fencepost::test {
namespace {

constexpr Drift kDrift{"1 %, 1 deg/m", 0.01, 1, 0.5, 0};
constexpr std::uint64_t kMinViews = 4;

Tour drive_path(const PathOptions& options) {
  DriftingOdometry odometry(options.seed, options.drift ? kDrift : Drift{});
  return drive_tour(path_scene(options.path, options.seed), noise_levels({"2"}).front().blob,
                    [&](const sensor::OdometrySample& sample) { return odometry.next(sample); });
}

host::Evaluation run_log(const Tour& tour, const PathOptions& options) {
  host::EvaluateOptions evaluate_options;
  evaluate_options.profile = options.profile;
  const char* correct = options.feed == Feed::kCorrected ? "on" : "off";
  const std::string log = with_setting(tour.log, record::Setting{"correct.pose", std::string_view(correct)});
  const std::string name = "seed " + std::to_string(options.seed);
  host::EvaluateOutcome outcome =
      host::evaluate(log, name, tour.scene, host::FrameTruths(tour.frames), evaluate_options);
  if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
  if (!outcome.evaluation.frame_truth) throw std::runtime_error(name + ": the frames of the log are not the path's");
  return std::move(outcome.evaluation);
}

ObjectScores scores_at_end(const host::ObjectEvaluation& object, const std::vector<std::string>& models) {
  ObjectScores scores;
  for (const std::string& model : models) scores[model] = {};
  for (const host::Cut& cut : object.cuts) {
    if (!cut.end) continue;
    for (const host::ModelScore& entry : cut.models) scores[entry.model] = entry.score;
  }
  return scores;
}

}  // namespace

std::vector<ObjectScores> run_path(const PathOptions& options) {
  const Tour tour = drive_path(options);
  const host::Evaluation evaluation =
      options.feed == Feed::kGiven ? run_given(tour, options.profile) : run_log(tour, options);
  std::vector<ObjectScores> objects;
  for (const host::ObjectEvaluation& object : evaluation.objects) {
    if (object.visible >= kMinViews) objects.push_back(scores_at_end(object, evaluation.models));
  }
  return objects;
}

}  // namespace fencepost::test
