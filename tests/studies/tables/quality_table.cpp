// Prints R / P / IoU of every model at 2, 4, 8, 18 and 75 views on random scenes. There is a table a noise level and
// kind of flags, and one beside the reference if there is one. The last column is the end of the circle, whether or not
// all of its 75 views showed the object. Fails if a cell with true flags fails against the reference.
#include <algorithm>
#include <map>

#include "tests/studies/common/study.hpp"
#include "tests/studies/tables/quality_run.hpp"
#include "tests/studies/tables/table_text.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds;
  std::vector<std::string> levels;
  std::vector<std::string> flags{"true", "inferred"};
  std::string reference;
  QualityOptions options;
};

std::vector<host::Evaluation> run_level(const Request& request, const NoiseLevel& level, const std::string& flags) {
  QualityOptions options = request.options;
  options.flags = flags == "true" ? OcclusionFlags::kTrue : OcclusionFlags::kInferred;
  return request.seeds.each([&](unsigned seed) { return run_scene(seed, level, options); });
}

/// The cells of all levels, one entry a kind of flags.
std::vector<Compared> run_levels(const Request& request, const std::vector<ReferenceCell>& reference) {
  std::vector<Compared> all;
  for (const std::string& flags : request.flags) all.push_back({flags, {}});
  for (const NoiseLevel& level : noise_levels(request.levels)) {
    std::vector<Compared> here;
    for (Compared& kind : all) {
      const std::vector<host::Evaluation> evaluations = run_level(request, level, kind.flags);
      print(level_table(level, kind.flags, host::summarise(evaluations, kTableViews)));
      if (reference.empty()) continue;
      here.push_back({kind.flags, compare(level.key, evaluations, reference)});
      kind.cells.insert(kind.cells.end(), here.back().cells.begin(), here.back().cells.end());
    }
    if (!here.empty() && !here.front().cells.empty()) print(comparison_table(level, here));
  }
  return all;
}

/// False if a cell that has to reach the reference does not.
bool run(const Request& request) {
  std::vector<ReferenceCell> reference;
  if (!request.reference.empty()) reference = load_reference(request.reference);
  const std::vector<Compared> all = run_levels(request, reference);
  if (reference.empty()) return true;
  bool reached = true;
  std::size_t compared = 0;
  for (const Compared& kind : all) {
    print(verdict(kind));
    compared += kind.cells.size();
    const bool fails = std::any_of(kind.cells.begin(), kind.cells.end(), [](const auto& cell) { return cell.fails(); });
    if (fails && kind.flags == "true") reached = false;
  }
  if (compared == 0) throw std::runtime_error("no cell of the reference is at these noise levels");
  return reached;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "scenes a table, three objects each");
  add_levels_option(app, request.levels);
  app.add_option("--flags", request.flags,
                 "whose each blob is and which ends are hidden: true, inferred as on the robot")
      ->delimiter(',')
      ->capture_default_str()
      ->check(CLI::IsMember({"true", "inferred"}));
  app.add_option("--compare", request.reference, "a file of reference figures (tests/studies/tables/reference.csv)");
  app.add_option("--scene", request.options.kind, "sequential views, the same spread, or two convex objects")
      ->transform(CLI::CheckedTransformer(std::map<std::string, SceneKind>{
          {"sequential", SceneKind::kSequential}, {"spread", SceneKind::kSpread}, {"convex", SceneKind::kTwoConvex}}));
  add_profile_option(app, request.options.profile);
  app.add_option("--dump", request.options.dump, "a folder for the scenes and logs, for fencepost evaluate");
}

constexpr Study<Request> kStudy = {
    "quality_table", "R / P / IoU of every model on random scenes, a table a noise level and kind of flags", options,
    run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
