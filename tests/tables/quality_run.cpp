#include "tests/tables/quality_run.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "host/geometry/planar.hpp"
#include "host/scene/load.hpp"
#include "host/simulate/simulate.hpp"
#include "tests/identity/random_scene.hpp"

namespace fencepost::test {
namespace {

constexpr int kObjects = 3;

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

}  // namespace

host::Evaluation run_scene(unsigned seed, const NoiseLevel& level, const QualityOptions& options) {
  if (options.flags == OcclusionFlags::kTrue) {
    throw std::runtime_error("true occlusion flags have no way into the map yet; use --flags inferred");
  }
  host::Scene scene = random_scene(seed, kObjects, Colours::kAllDifferent, 0);
  scene.noise = level.noise;
  std::string log;
  const auto summary = host::simulate(scene, [&](std::string_view line) { log += line; });
  if (!summary.ok()) throw std::runtime_error(summary.error());

  if (!options.dump.empty()) dump(options.dump, std::string(level.key) + "_" + std::to_string(seed), scene, log);

  host::EvaluateOptions evaluate_options;
  evaluate_options.views = kTableViews;
  evaluate_options.profile = options.profile;
  host::EvaluateOutcome outcome = host::evaluate(log, "seed " + std::to_string(seed), scene, evaluate_options);
  if (outcome.replay.unreadable) throw std::runtime_error(outcome.replay.unreadable->message);
  if (!outcome.evaluation.frame_truth) throw std::runtime_error("the simulator does not recognise its own frames");
  add_hull_limit(scene, outcome.evaluation);
  return std::move(outcome.evaluation);
}

}  // namespace fencepost::test
