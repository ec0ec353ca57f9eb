// Pose correction on fifteen minutes of each of sixteen real robots, which log commanded velocities. The map, the
// objects too many, the path where it was surveyed.
#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "tests/studies/common/median.hpp"
#include "tests/studies/common/study.hpp"
#include "tests/studies/drift/real_run.hpp"

namespace fencepost::test {
namespace {

/// The targets of all runs together.
constexpr double kMedian = 0.08;      // m
constexpr double kWorst = 0.14;       // m
constexpr std::size_t kObjects = 18;  // for 15 landmarks

struct Request {
  std::vector<std::string> only;
  std::vector<std::string> settings;
  bool judge = true;
  RealOptions options;

  [[nodiscard]] bool wants(const RealRun& run) const {
    return only.empty() ||
           std::any_of(only.begin(), only.end(), [&](const auto& start) { return run.name.starts_with(start); });
  }
};

constexpr double kDegrees = 57.29577951308232;

void print_row(const RealRun& run, const RealResult& result) {
  std::string row = fmt::format("| {} | {:.3f} | {:.3f} | {:.3f} | {} | {} | {} |", run.name, result.map,
                                result.landmarks.back(), result.scale, result.objects, result.missing, result.movers);
  row += result.textbook ? fmt::format(" {:.3f} |", *result.textbook) : " |";
  if (result.path) {
    row += fmt::format(" {:.2f} m {:.1f} deg | {:.2f} m | {:.1f} deg |\n", result.path->mean,
                       result.path->heading * kDegrees, result.path->shape, result.turned * kDegrees);
  } else {
    row += " | | |\n";
  }
  print(row);
}

bool run(const Request& request) {
  Request wanted = request;
  for (const std::string& setting : request.settings) {
    const std::size_t equals = setting.find('=');
    wanted.options.settings.emplace_back(setting.substr(0, equals), setting.substr(equals + 1));
  }
  print(
      "| run | map, rms | worst | scale | objects | missing | movers | textbook | pose off | path, aligned | map "
      "turned |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<double> maps;
  std::vector<double> textbook;
  std::size_t objects = 0;
  for (const RealRun& run : real_runs()) {
    if (!wanted.wants(run) || (wanted.options.surveyed && !has_survey(run))) continue;
    if (!present(run)) {
      print(fmt::format("NOT MEASURED: {} is not on this machine\n", run.folder));
      continue;
    }
    const RealResult result = run_real(run, wanted.options);
    print_row(run, result);
    maps.push_back(result.map);
    if (result.textbook) textbook.push_back(*result.textbook);
    objects = std::max(objects, result.objects);
  }
  if (maps.empty()) return true;
  const double median = median_of(maps);
  const double worst = std::ranges::max(maps);
  const bool reached = median <= kMedian && worst <= kWorst && objects <= kObjects;
  print(fmt::format("\nmedian {:.3f} m, worst {:.3f} m, at most {} objects; wanted: {:.2f}, {:.2f}, {}\n", median,
                    worst, objects, kMedian, kWorst, kObjects));
  if (!textbook.empty()) {
    print(fmt::format("a textbook filter: median {:.3f} m, worst {:.3f}\n", median_of(textbook),
                      std::ranges::max(textbook)));
  }
  return reached || !request.judge;
}

void options(CLI::App& app, Request& request) {
  app.add_option("--runs", request.only, "first characters of their names: D1, D4, D6, D7")->delimiter(',');
  app.add_option("--set", request.settings, "KEY=VALUE, beside the defaults");
  app.add_flag("--rows", request.options.rows, "ranges also as ground rows; without, widths and bearings");
  app.add_flag("--widths", request.options.widths, "the widths of things are configured");
  app.add_flag("--surveyed", request.options.surveyed, "by the true poses: what correction costs good odometry");
  app.add_flag("--robots", request.options.robots, "the other robots, too, as one signature");
  add_profile_option(app, request.options.profile);
  app.add_flag("!--no-judgement", request.judge, "print only");
}

constexpr Study<Request> kStudy = {"real_drift_study", "Pose correction on real runs.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
