// Prints the paper's Figure 10 over many random scenes, at three degrees of difficulty, and says whether what is asked
// of each algorithm was reached; status 1 if it was not.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>

#include "tests/reacquisition/study_tables.hpp"
#include "tests/tables/study.hpp"

namespace fencepost::test {
namespace {

int run(int argc, char** argv) {
  unsigned scenes = 60;
  unsigned first_seed = 1001;
  std::vector<std::string> keys;
  CLI::App app("How often each model finds two landmarks again, on random scenes of 75 views");
  app.add_option("--scenes", scenes, "of each kind")->capture_default_str();
  app.add_option("--first-seed", first_seed, "seed of the first scene")->capture_default_str();
  std::vector<std::string> known;
  for (const StudyWorld& world : study_worlds()) known.emplace_back(world.key);
  app.add_option("--worlds", keys, "kinds of scenes; default: all")->delimiter(',')->check(CLI::IsMember(known));
  bool recoloured = false;
  app.add_flag("--plant-recoloured", recoloured, "a planted fault: all models are rendered in grey");
  CLI11_PARSE(app, argc, argv);

  bool reached = true;
  for (const StudyWorld& world : study_worlds()) {
    if (!keys.empty() && std::find(keys.begin(), keys.end(), world.key) == keys.end()) continue;
    const StudyScores scores = run_world(world, scenes, first_seed, recoloured);
    fmt::print("{}\n", study_table(world, scenes, scores));
    for (const Verdict& verdict : verdicts(world, scores)) {
      fmt::print("{}", verdict.text);
      reached = reached && verdict.reached;
    }
    std::fflush(stdout);
  }
  return reached ? 0 : 1;
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) {
  return fencepost::test::run_study("reacquisition_study", fencepost::test::run, argc, argv);
}
