// Prints R / P / IoU of every model at 2, 4, 8, 18 and 75 views on random scenes, a table a noise level. The last
// column is the end of the circle, whether or not all of its 75 views showed the object.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>

#include "tests/tables/quality_run.hpp"

namespace fencepost::test {
namespace {

struct Request {
  unsigned scenes = 100;
  unsigned first_seed = 1;
  std::vector<std::string> levels;
  std::string flags = "inferred";
  QualityOptions options;
};

void print_table(const NoiseLevel& level, const std::string& flags, const host::Summary& summary) {
  fmt::print("**{}** (R / P / IoU, %; {} flags)\n\n| model |", level.name, flags);
  for (const std::uint32_t views : kTableViews) fmt::print(" {} |", views == 2 ? "n=2" : std::to_string(views));
  fmt::print(" 75 |\n|---|---|---|---|---|---|");
  std::string model;
  double worst_early = 0;
  double worst_end = 0;
  for (const host::SummaryRow& row : summary.rows) {
    if (row.model != model) fmt::print("\n| {} |", row.model);
    model = row.model;
    fmt::print(" {:.0f} / {:.0f} / {:.0f} |", 100 * row.recklessness.mean, 100 * row.paranoia.mean, 100 * row.iou.mean);
    double& worst = row.views ? worst_early : worst_end;
    for (const host::Mean* mean : {&row.recklessness, &row.paranoia}) {
      worst = std::max(worst, 100 * mean->standard_error.value_or(0));
    }
  }
  fmt::print("\n\n{} objects of {} scenes: {} missed, {} phantoms, {} identity swaps; ", summary.objects, summary.logs,
             summary.missed, summary.phantoms, summary.swaps.value_or(0));
  fmt::print("standard error of R and P at most {:.1f} points, {:.1f} at the end.\n\n", worst_early, worst_end);
  std::fflush(stdout);
}

void run(const Request& request) {
  for (const NoiseLevel& level : noise_levels()) {
    const auto& wanted = request.levels;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), level.key) == wanted.end()) continue;
    std::vector<host::Evaluation> evaluations;
    for (unsigned i = 0; i < request.scenes; ++i) {
      evaluations.push_back(run_scene(request.first_seed + i, level, request.options));
    }
    print_table(level, request.flags, host::summarise(evaluations, kTableViews));
  }
}

int run_program(int argc, char** argv) {
  Request request;
  CLI::App app("R / P / IoU of every model on random scenes, a table a noise level");
  app.add_option("--scenes", request.scenes, "scenes a table, three objects each")->capture_default_str();
  app.add_option("--first-seed", request.first_seed, "seed of the first scene")->capture_default_str();
  app.add_option("--levels", request.levels, "of 0,1,2,3,4,S,T; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember({"0", "1", "2", "3", "4", "S", "T"}));
  app.add_option("--flags", request.flags, "which ends of a blob are hidden: inferred as on the robot, or true")
      ->capture_default_str()
      ->check(CLI::IsMember({"inferred", "true"}));
  app.add_option("--profile", request.options.profile, "capacities of the robot")->capture_default_str();
  app.add_option("--dump", request.options.dump, "a folder for the scenes and logs, for fencepost evaluate");
  CLI11_PARSE(app, argc, argv);
  if (request.flags == "true") request.options.flags = OcclusionFlags::kTrue;
  run(request);
  return 0;
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  try {
    return fencepost::test::run_program(argc, argv);
  } catch (const std::exception& error) {
    static_cast<void>(std::fprintf(stderr, "quality_table: %s\n", error.what()));
    return 1;
  }
}
