// The models along realistic paths, beside our prototype's figures. Prints Markdown; fails if the hybrid is worse than
// the prototype's was with rows. The seeds from 5001 on were used for tuning.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "tests/studies/common/study.hpp"
#include "tests/studies/paths/path_judgement.hpp"

namespace fencepost::test {
namespace {

struct Request {
  Seeds seeds;
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

/// The prototype's flags were given, and so was the drift of its odometry. Ours has the drift when it corrects the
/// pose.
bool is_judged(const FeedText& feed, bool drift) { return feed.feed == (drift ? Feed::kCorrected : Feed::kGiven); }

std::string hybrid_cell(const PathMean& mean, const PathReference& reference, const FeedText& feed,
                        const std::string& where, Tally& tally) {
  const bool holds = reaches(mean, reference);
  const std::string text = fmt::format("{:.1f} ± {:.1f} of {:.1f} ± {:.1f}", mean.sum(), mean.standard_error,
                                       reference.hybrid_with_rows, reference.standard_error);
  const std::string_view mark = is_judged(feed, reference.drift) ? tally.look(holds, where + ": " + text)
                                : holds                          ? ""
                                                                 : " *";
  return fmt::format(" {:.1f} / {:.1f} | {}{} |", mean.recklessness, mean.paranoia, text, mark);
}

void print_row(const Request& request, const PathText& path, const PathReference& reference, const FeedText& feed,
               Tally& tally) {
  PathOptions options;
  options.path = path.path;
  options.feed = feed.feed;
  options.drift = reference.drift;
  options.profile = request.profile;
  const std::vector<SceneScores> scenes = request.seeds.each([&options](unsigned seed) {
    options.seed = seed;
    return run_path(options);
  });
  const auto beside = [&](const char* model, double figure) {
    return fmt::format(" {:.0f} ({:.0f}) |", mean_of(scenes, model).sum(), figure);
  };
  const std::string where = fmt::format("{}, {}{}", path.name, feed.name, reference.drift ? ", drift" : "");
  std::string row = fmt::format("| {} | {} |", path.name, feed.name);
  row += hybrid_cell(mean_of(scenes, "hybrid"), reference, feed, where, tally);
  row += beside("cylinder_paper", reference.cylinder) + beside("sheaf", reference.sheaf) +
         beside("clip_paper", reference.carving);
  row += fmt::format(" {:.0f} |", mean_of(scenes, "cylinder").sum());
  print(row + "\n");
}

bool wants(const Request& request, const PathText& path) {
  return request.paths.empty() ||
         std::find(request.paths.begin(), request.paths.end(), path.key) != request.paths.end();
}

void print_table(const Request& request, bool drift, Tally& tally) {
  fmt::print("**{}** (R + P, %; in brackets our prototype's; {} scenes, profile {})\n\n",
             drift ? "Drift of 1 % and 1 degree a metre" : "Without drift", request.seeds.scenes, request.profile);
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

bool run(const Request& request) {
  Tally tally;
  if (request.drift != "on") print_table(request, false, tally);
  if (request.drift != "off") print_table(request, true, tally);
  return tally.report(request.seeds);
}

void options(CLI::App& app, Request& request) {
  add_seed_options(app, request.seeds, "three objects each");
  std::vector<std::string> keys;
  for (const PathText& path : kPaths) keys.emplace_back(path.key);
  app.add_option("--paths", request.paths, "default: all")->delimiter(',')->check(CLI::IsMember(keys));
  app.add_option("--drift", request.drift)->check(CLI::IsMember({"both", "on", "off"}))->capture_default_str();
  add_profile_option(app, request.profile);
}

constexpr Study<Request> kStudy = {"path_table", "The models along realistic paths.", options, run};

}  // namespace
}  // namespace fencepost::test

int main(int argc, char** argv) { return fencepost::test::kStudy.main(argc, argv); }
