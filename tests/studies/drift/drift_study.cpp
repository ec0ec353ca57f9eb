// Pose correction against drifting odometry: the share of the pose error that it removes, and the models' R + P then.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tests/studies/common/study.hpp"
#include "tests/studies/drift/drift_run.hpp"

namespace fencepost::test {
namespace {

/// Means over the scenes.
struct Means {
  double position = 0;
  double heading = 0;
  std::map<std::string, double> sum;
};

Means mean_of(const Seeds& seeds, DriftOptions options) {
  const auto results = seeds.each([&options](unsigned seed) {
    options.seed = seed;
    return run_drift(options);
  });
  const auto scenes = static_cast<double>(results.size());
  Means means;
  for (const DriftResult& result : results) {
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

/// The drift that is judged, in one loop.
constexpr std::string_view kJudged = "3 %, 2 deg/m";
constexpr double kPositionRemoved = 0.60;  // minimum share of its position error that correction removes
constexpr double kHeadingRemoved = 0.55;   // minimum share of its heading error that correction removes

struct Request {
  Seeds seeds;
  std::vector<int> loops{1, 2};
  std::vector<std::string> only;
  double most = 58;
  bool judge = true;
  DriftOptions options;

  [[nodiscard]] bool wants(const Drift& drift) const {
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const auto& start) { return drift.key.starts_with(start); });
  }
};

/// The share of the odometry's errors that the correction has removed, and whether that is enough.
struct Removed {
  double position = 0;
  double heading = 0;
  bool enough = false;
};

// A row each: the poses of the odometry, those corrected always, and those corrected by itself, which are judged.
Removed print_rows(const Request& request, const Drift& drift, DriftOptions options) {
  options.drift = drift;
  options.correct = "off";
  const Means raw = mean_of(request.seeds, options);
  print(fmt::format("| {} | odometry |{}\n", drift.key, row_of(raw)));
  Means corrected;
  for (const char* mode : {"on", "auto"}) {
    options.correct = mode;
    corrected = mean_of(request.seeds, options);
    print(fmt::format("| {} | {} |{}\n", drift.key, mode, row_of(corrected)));
  }
  Removed removed{1 - corrected.position / raw.position, 1 - corrected.heading / raw.heading, false};
  removed.enough = removed.position >= kPositionRemoved && removed.heading >= kHeadingRemoved &&
                   corrected.sum.at("hybrid") <= request.most;
  return removed;
}

/// False if the drift that is judged is not removed well enough.
bool print_table(const Request& request, int loops) {
  DriftOptions options = request.options;
  options.loops = loops;
  print(fmt::format("**{} loop(s), {} scenes, profile {}**\n\n", loops, request.seeds.scenes, options.profile));
  print(
      "| drift | pose | error | hybrid | cylinder | cylinder_paper | carve | clip "
      "|\n|---|---|---|---|---|---|---|---|\n");
  bool reached = true;
  std::string list;
  for (const Drift& drift : drifts()) {
    if (!request.wants(drift)) continue;
    const Removed removed = print_rows(request, drift, options);
    if (drift.scale == 0) continue;
    const bool missed = request.judge && drift.key == kJudged && loops == 1 && !removed.enough;
    list += fmt::format("- {}: {:.0f} % of the position and {:.0f} % of the heading error removed{}\n", drift.key,
                        100 * removed.position, 100 * removed.heading, missed ? " **" : "");
    reached = reached && !missed;
  }
  print(fmt::format("\n{}\n", list));
  return reached;
}

bool run(const Request& request) {
  bool reached = true;
  for (const int loops : request.loops) reached = print_table(request, loops) && reached;
  if (!reached)
    fmt::print(stderr, "drift_study: targets missed: {:.0f} % of the position, {:.0f} % of the heading, sum {:.0f}\n",
               100 * kPositionRemoved, 100 * kHeadingRemoved, request.most);
  return reached;
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "random loops a row");
  app.add_option("--loops", request.loops)->delimiter(',');
  app.add_option("--drifts", request.only, "first characters of their names")->delimiter(',');
  add_profile_option(app, request.options.profile);
  app.add_option("--level", request.options.level, "of noise")->capture_default_str();
  app.add_option("--most", request.most, "R + P of the hybrid, in percent, that is good enough")->capture_default_str();
  app.add_flag("!--no-judgement", request.judge, "print only");
}

constexpr Study<Request> kStudy = {"drift_study", "Pose correction on random loops.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
