// The models along realistic paths, beside our prototype's figures. Prints Markdown; fails if the hybrid is worse than
// the prototype's was with rows. The seeds from 5001 on were used for tuning.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>
#include <vector>

#include "tests/paths/path_judgement.hpp"
#include "tests/tables/study.hpp"

namespace fencepost::test {
namespace {

struct Request {
  unsigned scenes = 100;
  unsigned first_seed = 1;
  std::vector<std::string> paths;
  std::string drift = "both";
  std::string profile = "full";
};

/// A row of the table.
struct FeedText {
  Feed feed;
  const char* name;
};
constexpr std::array<FeedText, 3> kFeeds = {
    {{Feed::kGiven, "flags given"}, {Feed::kLog, "from the log"}, {Feed::kCorrected, "from the log, pose corrected"}}};

/// The prototype's flags were given, and it was told how far its odometry drifts: ours is told so when it corrects it.
bool is_judged(const FeedText& feed, bool drift) { return feed.feed == (drift ? Feed::kCorrected : Feed::kGiven); }

struct Tally {
  int claims = 0;
  std::vector<std::string> broken;
};

std::vector<SceneScores> run_scenes(const Request& request, PathOptions options) {
  std::vector<SceneScores> scenes;
  for (unsigned i = 0; i < request.scenes; ++i) {
    options.seed = request.first_seed + i;
    scenes.push_back(run_path(options));
  }
  return scenes;
}

std::string hybrid_cell(const PathMean& mean, const PathReference& reference, const FeedText& feed,
                        const std::string& where, Tally& tally) {
  const bool holds = reaches(mean, reference);
  const bool judged = is_judged(feed, reference.drift);
  if (judged) ++tally.claims;
  const std::string text = fmt::format("{:.1f} ± {:.1f} of {:.1f} ± {:.1f}", mean.sum(), mean.standard_error,
                                       reference.hybrid_with_rows, reference.standard_error);
  if (judged && !holds) tally.broken.push_back(where + ": " + text);
  return fmt::format(" {:.1f} / {:.1f} | {}{} |", mean.recklessness, mean.paranoia, text,
                     holds    ? ""
                     : judged ? " **"
                              : " *");
}

void print_row(const Request& request, const PathText& path, const PathReference& reference, const FeedText& feed,
               Tally& tally) {
  PathOptions options;
  options.path = path.path;
  options.feed = feed.feed;
  options.drift = reference.drift;
  options.profile = request.profile;
  const std::vector<SceneScores> scenes = run_scenes(request, options);
  const auto beside = [&](const char* model, double figure) {
    return fmt::format(" {:.0f} ({:.0f}) |", mean_of(scenes, model).sum(), figure);
  };
  const std::string where = fmt::format("{}, {}{}", path.name, feed.name, reference.drift ? ", drift" : "");
  std::string row = fmt::format("| {} | {} |", path.name, feed.name);
  row += hybrid_cell(mean_of(scenes, "hybrid"), reference, feed, where, tally);
  row += beside("cylinder_paper", reference.cylinder) + beside("sheaf", reference.sheaf) +
         beside("clip", reference.carving);
  row += fmt::format(" {:.0f} |", mean_of(scenes, "cylinder").sum());
  fmt::print("{}\n", row);
  static_cast<void>(std::fflush(stdout));
}

bool wants(const Request& request, const PathText& path) {
  return request.paths.empty() ||
         std::find(request.paths.begin(), request.paths.end(), path.key) != request.paths.end();
}

void print_table(const Request& request, bool drift, Tally& tally) {
  fmt::print("**{}** (R + P, %; in brackets our prototype's; {} scenes, profile {})\n\n",
             drift ? "Drift of 1 % and 1 degree a metre" : "Without drift", request.scenes, request.profile);
  fmt::print(
      "| path | models | hybrid R / P | R + P of the prototype's with rows | cylinder_paper | sheaf | clip | cylinder "
      "|\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const PathText& path : kPaths) {
    if (!wants(request, path)) continue;
    for (const PathReference& reference : kPathReferences) {
      if (reference.path != path.path || reference.drift != drift) continue;
      for (const FeedText& feed : kFeeds) {
        if (feed.feed != Feed::kCorrected || drift) print_row(request, path, reference, feed, tally);
      }
    }
  }
  fmt::print("\n");
}

int run(int argc, char** argv) {
  Request request;
  CLI::App app{"The models along realistic paths."};
  app.add_option("--scenes", request.scenes, "three objects each")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--first-seed", request.first_seed)->capture_default_str();
  std::vector<std::string> keys;
  for (const PathText& path : kPaths) keys.emplace_back(path.key);
  app.add_option("--paths", request.paths, "default: all")->delimiter(',')->check(CLI::IsMember(keys));
  app.add_option("--drift", request.drift)->check(CLI::IsMember({"both", "on", "off"}))->capture_default_str();
  app.add_option("--profile", request.profile)->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  Tally tally;
  if (request.drift != "on") print_table(request, false, tally);
  if (request.drift != "off") print_table(request, true, tally);
  for (const std::string& claim : tally.broken) fmt::print("broken: {}\n", claim);
  fmt::print("{} claims, {} broken; {} scenes from seed {}\n", tally.claims, tally.broken.size(), request.scenes,
             request.first_seed);
  return tally.broken.empty() ? 0 : 1;
}

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::run_study("path_table", fencepost::test::run, argc, argv); }
