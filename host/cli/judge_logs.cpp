#include "host/cli/judge_logs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <utility>

#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/jobs/jobs.hpp"

namespace fencepost::host::cli {
namespace {

/// "logs/run.log" has its scene in "logs/run.json".
std::string scene_beside(const std::string& log) {
  const std::string scene = std::filesystem::path(log).replace_extension(".json").string();
  std::error_code error;
  const std::filesystem::file_type kind = std::filesystem::status(log, error).type();
  using enum std::filesystem::file_type;
  if (kind == not_found || kind == directory) static_cast<void>(read_input(log));  // says why it cannot
  if (std::filesystem::exists(scene, error)) return scene;
  if (error)
    throw Failure(Exit::kUnreadable,
                  "cannot look for the scene " + scene + ": " + error.message() + "; name it with --scene SCENE");
  throw Failure(Exit::kUnreadable, log + ": no scene " + scene + " beside it; name it with --scene SCENE");
}

template <class Entry, class Name>
void keep_named(std::vector<Entry>& entries, const std::vector<std::string>& names, Name name) {
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const Entry& entry) {
                                 return std::find(names.begin(), names.end(), name(entry)) == names.end();
                               }),
                entries.end());
}

/// How far all logs are, in bytes where they are all files, else in logs.
class Advance {
 public:
  explicit Advance(const std::vector<std::string>& logs) : logs_(logs.size()), progress_("evaluating") {
    for (const std::string& log : logs) {
      std::error_code error;
      const std::uintmax_t size =
          std::filesystem::is_regular_file(log, error) ? std::filesystem::file_size(log, error) : 0;
      if (error || size == 0) by_bytes_ = false;
      bytes_ += size;
    }
  }
  void read(std::size_t bytes) {
    read_ += bytes;
    show();
  }
  void done() {
    ++done_;
    show();
  }

 private:
  void show() {
    const std::size_t done = done_;
    const std::string detail = logs_ > 1 ? fmt::format("{} of {} logs", done, logs_) : "";
    if (by_bytes_) progress_.at(static_cast<double>(read_), static_cast<double>(bytes_), detail);
    if (!by_bytes_) progress_.at(static_cast<double>(done), static_cast<double>(logs_), detail);
  }

  std::size_t logs_;
  bool by_bytes_ = true;
  std::uintmax_t bytes_ = 0;
  std::atomic<std::uintmax_t> read_ = 0;
  std::atomic<std::size_t> done_ = 0;
  Progress progress_;
};

void judge_pair(const EvaluateRequest& request, const EvaluateOptions& options, std::size_t pair, Advance& advance,
                Judged& judged) {
  const std::string& log = request.logs[pair];
  const std::string scene_name = request.scenes.empty() ? scene_beside(log) : request.scenes[pair];
  const Scene scene = read_scene(scene_name);
  const std::string name = input_name(log);
  LogInput input(log);
  const LogSource source = [&] {
    const std::uint64_t before = input.position();
    const std::string_view bytes = input.next();
    advance.read(input.position() - before);
    return bytes;
  };
  EvaluateOutcome outcome = evaluate(source, name, scene, options);
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  judged.said = what_was_left_out(outcome.replay, request.logs.size() > 1 ? name : "");
  outcome.evaluation.log = name;
  outcome.evaluation.scene = input_name(scene_name);
  if (!request.models.empty()) keep_models(outcome.evaluation, request.models);
  if (request.smooth) judged.smoothed = smooth_log(log, scene, options);
  judged.evaluation = std::move(outcome.evaluation);
}

}  // namespace

void keep_models(Evaluation& evaluation, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto& known = evaluation.models;
    if (known.empty() || std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw Failure(Exit::kUsage, fmt::format("no model {} in profile {}; there are {}", name, evaluation.profile,
                                            fmt::join(known, ", ")));
  }
  keep_named(evaluation.models, names, [](const std::string& model) { return model; });
  for (ObjectEvaluation& object : evaluation.objects) {
    for (Cut& cut : object.cuts) keep_named(cut.models, names, [](const ModelScore& entry) { return entry.model; });
  }
}

std::vector<Judged> judge_logs(const EvaluateRequest& request, const EvaluateOptions& options) {
  std::vector<Judged> all(request.logs.size());
  Advance advance(request.logs);
  run_jobs(all.size(), request.jobs > 0 ? request.jobs : all_cores(), [&](std::size_t i) {
    try {
      judge_pair(request, options, i, advance, all[i]);
    } catch (const Failure& failure) {
      all[i].failure = failure;
    }
    advance.done();
  });
  return all;
}

}  // namespace fencepost::host::cli
