// Prints the paper's Figure 10 over many random scenes, at three degrees of difficulty. Says whether each algorithm
// reached its targets; status 1 if one did not.
#include <algorithm>
#include <string>
#include <vector>

#include "tests/studies/common/study.hpp"
#include "tests/studies/reacquisition/study_tables.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds{60, 1001};
  std::vector<std::string> worlds;
  bool recoloured = false;
};

bool run(const Request& request) {
  bool reached = true;
  for (const StudyWorld& world : study_worlds()) {
    const auto& wanted = request.worlds;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), world.key) == wanted.end()) continue;
    const StudyScores scores = run_world(world, request.seeds.scenes, request.seeds.first, request.recoloured);
    print(study_table(world, request.seeds.scenes, scores) + "\n");
    for (const Verdict& verdict : verdicts(world, scores)) {
      print(verdict.text);
      reached = reached && verdict.reached;
    }
  }
  return reached;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "of each kind");
  std::vector<std::string> known;
  for (const StudyWorld& world : study_worlds()) known.emplace_back(world.key);
  app.add_option("--worlds", request.worlds, "kinds of scenes; default: all")
      ->delimiter(',')
      ->check(CLI::IsMember(known));
  app.add_flag("--plant-recoloured", request.recoloured, "a planted fault: all models are rendered in grey");
}

constexpr Study<Request> kStudy = {"reacquisition_study",
                                   "How often each model finds two landmarks again, on random scenes of 75 views",
                                   options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
