// Pose correction against drifting odometry: how much of the pose error goes, and what the models are worth then.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <vector>

#include "tests/drift/drift_run.hpp"
#include "tests/tables/study.hpp"

namespace fencepost::test {
namespace {

/// Means over the scenes.
struct Means {
  double position = 0;
  double heading = 0;
  std::map<std::string, double> sum;
};

Means mean_of(unsigned scenes, unsigned first_seed, DriftOptions options) {
  Means means;
  for (unsigned i = 0; i < scenes; ++i) {
    options.seed = first_seed + i;
    const DriftResult result = run_drift(options);
    means.position += result.position / scenes;
    means.heading += result.heading / scenes;
    for (const auto& [model, sum] : result.sum) means.sum[model] += sum / scenes;
  }
  return means;
}

std::string row_of(const Means& means) {
  std::string row = fmt::format(" {:.0f} mm {:.2f} deg |", 1e3 * means.position, means.heading * 57.29577951308232);
  for (const char* model : {"hybrid", "cylinder", "cylinder_paper", "carve", "clip"}) {
    row += fmt::format(" {:.0f} |", means.sum.at(model));
  }
  return row;
}

/// What has to be reached with 3 %, 2 deg/m in one loop.
constexpr std::string_view kJudged = "3 %, 2 deg/m";
constexpr double kPositionRemoved = 0.60;
constexpr double kHeadingRemoved = 0.55;

int run(int argc, char** argv) {
  CLI::App app{"Pose correction on random loops."};
  unsigned scenes = 100;
  unsigned first_seed = 1;
  std::vector<int> loops{1, 2};
  DriftOptions options;
  std::vector<std::string> only;
  app.add_option("--scenes", scenes)->check(CLI::PositiveNumber);
  app.add_option("--first-seed", first_seed);
  app.add_option("--loops", loops)->delimiter(',');
  app.add_option("--drifts", only, "first characters of their names")->delimiter(',');
  app.add_option("--profile", options.profile);
  app.add_option("--level", options.level);
  double most = 58;
  app.add_option("--most", most, "R + P of the hybrid, in percent, that is good enough");
  bool judge = true;
  app.add_flag("!--no-judgement", judge, "print only");
  CLI11_PARSE(app, argc, argv);
  bool reached = true;
  for (const int count : loops) {
    options.loops = count;
    fmt::print("**{} loop(s), {} scenes, profile {}**\n\n", count, scenes, options.profile);
    fmt::print(
        "| drift | pose | error | hybrid | cylinder | cylinder_paper | carve | clip "
        "|\n|---|---|---|---|---|---|---|---|\n");
    std::string removed;
    for (const Drift& drift : drifts()) {
      if (!only.empty() &&
          std::none_of(only.begin(), only.end(), [&](const auto& o) { return drift.key.starts_with(o); }))
        continue;
      options.drift = drift;
      options.correct = false;
      const Means raw = mean_of(scenes, first_seed, options);
      fmt::print("| {} | odometry |{}\n", drift.key, row_of(raw));
      std::fflush(stdout);
      options.correct = true;
      const Means corrected = mean_of(scenes, first_seed, options);
      fmt::print("| {} | corrected |{}\n", drift.key, row_of(corrected));
      std::fflush(stdout);
      if (drift.scale == 0) continue;
      const double position = 1 - corrected.position / raw.position;
      const double heading = 1 - corrected.heading / raw.heading;
      const bool judged = judge && drift.key == kJudged && count == 1;
      const bool holds =
          position >= kPositionRemoved && heading >= kHeadingRemoved && corrected.sum.at("hybrid") <= most;
      removed += fmt::format("- {}: {:.0f} % of the position and {:.0f} % of the heading error removed{}\n", drift.key,
                             100 * position, 100 * heading, judged && !holds ? " **" : "");
      reached = reached && (!judged || holds);
    }
    fmt::print("\n{}\n", removed);
  }
  if (!reached)
    fmt::print(stderr, "drift_study: targets missed: {:.0f} % of the position, {:.0f} % of the heading, sum {:.0f}\n",
               100 * kPositionRemoved, 100 * kHeadingRemoved, most);
  return reached ? 0 : 1;
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::run_study("drift_study", fencepost::test::run, argc, argv); }
