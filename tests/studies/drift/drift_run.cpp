#include "tests/studies/drift/drift_run.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "host/evaluate/metrics.hpp"
#include "host/geometry/rings.hpp"
#include "host/replay/replay.hpp"
#include "tests/firmware/record/lines.hpp"
#include "tests/studies/tables/reference_scene.hpp"
#include "tests/studies/tables/tour.hpp"

namespace fencepost::test {
namespace {

struct DrivenLog {
  std::string text;
  std::vector<host::PoseResult> truth;
};

DrivenLog drive(const host::Scene& scene, const DriftOptions& options) {
  DriftingOdometry odometry(options.seed, options.drift);
  const Tour tour = drive_tour(scene, noise_levels({options.level}).front().blob,
                               [&](const sensor::OdometrySample& sample) { return odometry.next(sample); });
  const auto setting = [](std::string_view key, const std::string& value) {
    return record::Setting{key, std::string_view(value)};
  };
  const std::string log = with_setting(tour.log, setting("correct.drift", options.configured));
  return {with_setting(log, setting("correct.pose", options.correct)), odometry.truth()};
}

/// As seen by a robot that is at `truth` and believes to be at `estimate`.
host::MultiPolygon seen_from(host::MultiPolygon model, const host::PoseResult& estimate,
                             const host::PoseResult& truth) {
  for (host::Polygon& polygon : model) {
    polygon = host::moved(polygon, 0, {-estimate.x, -estimate.y});
    polygon = host::moved(polygon, truth.heading - estimate.heading, {truth.x, truth.y});
  }
  return model;
}

/// The object that is known best of those with its signature.
const host::ObjectResult* object_of(const host::ResultDocument& result, std::uint8_t signature) {
  const host::ObjectResult* best = nullptr;
  for (const host::ObjectResult& object : result.objects) {
    if (object.signature == signature && (best == nullptr || object.views > best->views)) best = &object;
  }
  return best;
}

void measure_pose(const std::vector<host::PoseResult>& path, const std::vector<host::PoseResult>& truth,
                  DriftResult& result) {
  if (path.size() != truth.size()) throw std::runtime_error("odometry was lost");
  const std::size_t from = truth.size() * 3 / 4;
  const auto count = static_cast<double>(truth.size() - from);
  for (std::size_t i = from; i < truth.size(); ++i) {
    result.position += std::hypot(path[i].x - truth[i].x, path[i].y - truth[i].y) / count;
    result.heading += std::fabs(std::remainder(path[i].heading - truth[i].heading, 2 * std::numbers::pi)) / count;
  }
}

}  // namespace

const std::vector<Drift>& drifts() {
  static const std::vector<Drift> kDrifts{
      {"1 %, 1 deg/m", 0.01, 1, 0.5}, {"3 %, 2 deg/m", 0.03, 2, 1}, {"5 %, 3 deg/m", 0.05, 3, 1.5}, {"none", 0, 0, 0}};
  return kDrifts;
}

std::string drift_log(const DriftOptions& options) {
  return drive(loop_scene(options.seed, options.loops), options).text;
}

DriftResult run_drift(const DriftOptions& options) {
  const host::Scene scene = loop_scene(options.seed, options.loops);
  const DrivenLog log = drive(scene, options);
  host::ReplayOptions replay_options;
  replay_options.profile = options.profile;
  const host::ReplayOutcome outcome = host::replay(log.text, "seed " + std::to_string(options.seed), replay_options);
  if (outcome.unreadable) throw std::runtime_error(outcome.unreadable->message);
  DriftResult result;
  measure_pose(outcome.result.path, log.truth, result);
  for (const host::SceneObject& truth : scene.objects) {
    const host::ObjectResult* found = object_of(outcome.result, truth.signature);
    for (const char* model : {"hybrid", "cylinder", "cylinder_paper", "carve", "clip"}) {
      host::Score score;
      for (const host::ModelResult& entry : found ? found->models : std::vector<host::ModelResult>{}) {
        if (entry.name != model) continue;
        score = host::score(seen_from(entry.geometry, *outcome.result.pose, log.truth.back()), truth.footprint);
      }
      result.sum[model] += 100 * (score.recklessness + score.paranoia) / static_cast<double>(scene.objects.size());
    }
  }
  return result;
}

}  // namespace fencepost::test
