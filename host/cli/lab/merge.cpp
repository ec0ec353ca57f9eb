#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/merge/merge.hpp"

namespace fencepost::host::cli {
namespace {

/// Where the runs of a log begin: at its headers, the first also at its start.
std::vector<std::string_view> runs_of(std::string_view bytes) {
  constexpr std::string_view kHeader = "$FPHDR,";
  std::vector<std::string_view> runs;
  std::size_t begin = 0;
  bool headed = bytes.starts_with(kHeader);
  for (std::size_t at = bytes.find(kHeader, 1); at != std::string_view::npos; at = bytes.find(kHeader, at + 1)) {
    if (bytes[at - 1] != '\n') continue;
    if (headed) {
      runs.push_back(bytes.substr(begin, at - begin));
      begin = at;
    }
    headed = true;
  }
  runs.push_back(bytes.substr(begin));
  return runs;
}

/// A robot that was carried and then got `reset` has two runs in one log. Runs without a usable frame are passed over,
/// unless there is no other.
void add_runs(const std::string& log, const std::string& bytes, const MergeRequest& request,
              const ReplayOptions& options, std::vector<RunMap>& maps) {
  const std::vector<std::string_view> runs = runs_of(bytes);
  std::optional<Unreadable> unreadable;
  bool any = false;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string name = input_name(log) + (runs.size() > 1 ? ", run " + std::to_string(i + 1) : "");
    ReplayOutcome outcome = replay(runs[i], name, options);
    if (outcome.unreadable) {
      unreadable = outcome.unreadable;
      continue;
    }
    any = true;
    say_what_was_left_out(outcome, request.logs.size() + runs.size() > 2 ? name : "");
    maps.push_back({name, std::move(outcome.result), runs[i], options.camera});
  }
  if (!any && unreadable) throw Failure(Exit::kUnreadable, unreadable->message);
}

}  // namespace

Exit run_merge(const MergeRequest& request) {
  const auto inputs = std::count(request.logs.begin(), request.logs.end(), "-") + (request.camera == "-" ? 1 : 0);
  if (inputs > 1) throw Failure(Exit::kUsage, "only one of the logs and --camera can be standard input");
  ReplayOptions options;
  options.profile = request.profile;
  if (!request.camera.empty()) options.camera = read_camera(request.camera);
  std::vector<RunMap> runs;
  std::vector<std::optional<std::string>> bytes;  // the runs point into them
  std::uint64_t all = 0;
  std::optional<Failure> failure;  // the first
  const auto or_left_out = [&](const auto& work) {
    try {
      work();
    } catch (const Failure& failed) {
      if (request.logs.size() > 1) say(std::string("left out: ") + failed.what());
      if (!failure) failure = failed;
    }
  };
  for (const std::string& log : request.logs) {
    bytes.emplace_back();
    or_left_out([&] { all += bytes.back().emplace(read_log(log)).size(); });
  }
  std::optional<Progress> progress("merging");
  std::uint64_t done = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (!bytes[i]) continue;
    or_left_out([&] { add_runs(request.logs[i], *bytes[i], request, options, runs); });
    done += bytes[i]->size();
    progress->at(static_cast<double>(done), static_cast<double>(all),
                 fmt::format("{} of {} logs", i + 1, bytes.size()));
  }
  if (runs.empty() && failure) throw Failure(*failure);
  const MergedMap merged = merge(runs);
  progress.reset();
  const bool colour = is_standard_output(request.output) && colour_on_stdout();
  write_output(request.output, request.json ? merge_json(merged) : merge_text(merged, colour));
  for (const std::string& note : merged.notes) say(note);
  Exit exit = Exit::kDone;
  for (const RunJoin& join : merged.runs) {
    if (join.joined()) continue;
    say(join.log + " is not in the map: " + reason(join));
    exit = Exit::kCheckFailed;
  }
  if (failure) exit = failure->code();
  return exit;
}

}  // namespace fencepost::host::cli
