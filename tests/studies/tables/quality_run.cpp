#include "tests/studies/tables/quality_run.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/geometry/planar.hpp"
#include "host/scene/load.hpp"
#include "tests/studies/tables/given_run.hpp"
#include "tests/studies/tables/reference_scene.hpp"
#include "tests/studies/tables/tour.hpp"

namespace fencepost::test {
namespace {

void add_hull_limit(const host::Scene& scene, host::Evaluation& evaluation) {
  evaluation.models.emplace_back(kHullLimit);
  for (host::ObjectEvaluation& object : evaluation.objects) {
    const host::Polygon& footprint = scene.objects[object.truth].footprint;
    const host::Score limit = host::score({host::convex_hull({footprint})}, footprint);
    for (host::Cut& cut : object.cuts) cut.models.push_back({kHullLimit, limit});
  }
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

void dump(const std::string& folder, const std::string& name, const host::Scene& scene, const std::string& log) {
  std::filesystem::create_directories(folder);
  write_file(std::filesystem::path(folder) / (name + ".json"), host::write_scene(scene));
  write_file(std::filesystem::path(folder) / (name + ".log"), log);
}

host::Evaluation run_log(unsigned seed, const Tour& tour, const QualityOptions& options) {
  host::EvaluateOptions evaluate_options;
  evaluate_options.views = kTableViews;
  evaluate_options.profile = options.profile;
  const std::string name = "seed " + std::to_string(seed);
  host::EvaluateOutcome outcome =
      host::evaluate(tour.log, name, tour.scene, host::FrameTruths(tour.frames), evaluate_options);
  if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
  if (!outcome.evaluation.frame_truth) throw std::runtime_error(name + ": the frames of the log are not the tour's");
  if (outcome.evaluation.frames != tour.frames.size()) throw std::runtime_error(name + ": the map refused frames");
  return std::move(outcome.evaluation);
}

}  // namespace

host::Scene scene_of(SceneKind kind, unsigned seed) {
  switch (kind) {
    case SceneKind::kSpread: return spread_scene(seed);
    case SceneKind::kTwoConvex: return two_objects_scene(seed);
    default: return reference_scene(seed);
  }
}

host::Evaluation run_scene(unsigned seed, const NoiseLevel& level, const QualityOptions& options) {
  const Tour tour = drive_tour(scene_of(options.kind, seed), level);
  if (!options.dump.empty())
    dump(options.dump, std::string(level.key) + "_" + std::to_string(seed), tour.scene, tour.log);
  host::Evaluation evaluation =
      options.flags == OcclusionFlags::kTrue ? run_given(tour, options.profile) : run_log(seed, tour, options);
  add_hull_limit(tour.scene, evaluation);
  return evaluation;
}

}  // namespace fencepost::test
