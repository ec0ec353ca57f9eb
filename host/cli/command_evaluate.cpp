#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/judge_logs.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/evaluate/evaluation_json.hpp"
#include "host/evaluate/evaluation_part.hpp"
#include "host/evaluate/evaluation_text.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

void check_usage(const EvaluateRequest& request) {
  if (request.logs.empty()) throw Failure(Exit::kUsage, "LOG is required; see fencepost evaluate --help");
  if (!request.scenes.empty() && request.scenes.size() != request.logs.size()) {
    throw Failure(Exit::kUsage,
                  fmt::format("{} and {}; give one --scene for each log, in the same order, "
                              "or none at all if each X.log has its X.json beside it",
                              plural(request.logs.size(), "log"), plural(request.scenes.size(), "scene")));
  }
  const auto inputs = std::count(request.logs.begin(), request.logs.end(), "-") +
                      std::count(request.scenes.begin(), request.scenes.end(), "-") + (request.camera == "-" ? 1 : 0);
  if (inputs > 1) throw Failure(Exit::kUsage, "only one of the logs, scenes and --camera can be standard input");
  if (request.scenes.empty() && inputs > (request.camera == "-" ? 1 : 0)) {
    throw Failure(Exit::kUsage, "a log from standard input needs --scene SCENE");
  }
  if (request.part && request.smooth) {
    throw Failure(Exit::kUsage, "--part has no room for --smooth; leave one out");
  }
  if (request.smooth && inputs > (request.camera == "-" ? 1 : 0)) {
    throw Failure(Exit::kUsage, "--smooth reads logs and scenes twice; put standard input into a file");
  }
}

bool exceeds(const SummaryRow& row, const char* what, const Mean& mean, std::optional<double> bound) {
  if (!bound || mean.mean <= *bound) return false;
  say(fmt::format("bound exceeded: {} of {} is {:.4f} at the end, allowed {}", what, row.model, mean.mean, *bound));
  return true;
}

Exit judge(const EvaluateRequest& request, const Summary& summary) {
  if (!request.max_recklessness && !request.max_paranoia) return Exit::kDone;
  bool exceeded = false;
  bool measured = false;
  for (const SummaryRow& row : summary.rows) {
    if (row.views || row.recklessness.n == 0) continue;
    measured = true;
    exceeded |= exceeds(row, "recklessness", row.recklessness, request.max_recklessness);
    exceeded |= exceeds(row, "paranoia", row.paranoia, request.max_paranoia);
  }
  if (!measured) say("no object was measured, so no bound is kept; does the scene belong to the log?");
  return exceeded || !measured ? Exit::kCheckFailed : Exit::kDone;
}

/// One unreadable log of several does not end the work. A single one does, and so does wrong usage.
EvaluationPart collect(std::vector<Judged>& all, const std::vector<std::string>& logs,
                       std::vector<std::uint32_t> views) {
  EvaluationPart part{std::move(views), {}, {}};
  const bool none = std::none_of(all.begin(), all.end(), [](const Judged& one) { return one.evaluation.has_value(); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const std::string& line : all[i].said) say(line);
    if (all[i].evaluation) part.evaluations.push_back(std::move(*all[i].evaluation));
    if (!all[i].failure) continue;
    const Failure& failure = *all[i].failure;
    if (failure.code() != Exit::kUnreadable || (none && i + 1 == all.size())) throw Failure(failure);
    say(failure.what());
    part.unjudged.push_back({input_name(logs[i]), failure.what()});
  }
  return part;
}

Exit conclude(const EvaluateRequest& request, const EvaluationPart& part, const std::vector<Judged>& judged) {
  const Summary summary = summarise(part.evaluations, part.views);
  std::string text = request.json ? to_json(part.evaluations, summary, part.views, part.unjudged)
                                  : evaluation_text(part.evaluations, summary, part.views, part.unjudged);
  if (request.smooth) {
    std::vector<SmoothEvaluation> smoothed;
    for (const Judged& one : judged) {
      if (one.evaluation && one.smoothed) smoothed.push_back(*one.smoothed);
    }
    text = with_smoothed(text, request.json, smoothed);
  }
  write_output(request.output, request.part ? part_json(part) : text);
  const Exit bounds = judge(request, summary);
  if (part.unjudged.empty()) return bounds;
  say(fmt::format("{} of {} could not be judged, see above", part.unjudged.size(),
                  plural(part.unjudged.size() + part.evaluations.size(), "log")));
  return Exit::kUnreadable;
}

/// Parts that were measured elsewhere.
Exit merge_parts(const EvaluateRequest& request) {
  if (!request.logs.empty() || !request.scenes.empty() || request.smooth || !request.camera.empty()) {
    throw Failure(Exit::kUsage, "--merge reads what 'evaluate --part' wrote, and neither logs nor scenes");
  }
  if (std::count(request.merge.begin(), request.merge.end(), "-") > 1) {
    throw Failure(Exit::kUsage, "only one of the parts can be standard input");
  }
  try {
    std::vector<EvaluationPart> parts;
    for (const std::string& file : request.merge) parts.push_back(read_part(read_input(file), input_name(file)));
    EvaluationPart whole = join_parts(std::move(parts));
    if (!request.models.empty()) {
      for (Evaluation& evaluation : whole.evaluations) keep_models(evaluation, request.models);
    }
    for (const UnjudgedLog& log : whole.unjudged) say(log.why);
    return conclude(request, whole, {});
  } catch (const NotAPart& problem) {
    throw Failure(Exit::kUnreadable, problem.what());
  }
}

Exit run(const EvaluateRequest& request) {
  if (!request.merge.empty()) return merge_parts(request);
  check_usage(request);
  if (request.smooth) need_lab("evaluate --smooth");
  EvaluateOptions options;
  options.profile = request.profile;
  std::vector<std::uint32_t>& views = options.views;
  views = request.views;
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  if (!request.camera.empty()) options.camera = read_camera(request.camera);
  std::vector<Judged> judged = judge_logs(request, options);
  const EvaluationPart part = collect(judged, request.logs, views);
  return conclude(request, part, judged);
}

Action configure_evaluate(Options command) {
  const auto request = std::make_shared<EvaluateRequest>();
  command.positional("LOG", request->logs, "recorded streams; - is standard input");
  command.value("--scene", request->scenes, "the truth, one for each LOG; default: X.json beside X.log")
      .takes("SCENE")
      .repeated();
  command.value("--views", request->views, "measure where an object has so many views; default: 2,4,8,18,75")
      .takes("N,N,...")
      .separated_by(',')
      .one_word()
      .positive();
  command.value("--model", request->models, "only these models; the bounds then hold for them only")
      .takes("NAME,...")
      .separated_by(',')
      .one_word();
  command.value("--max-recklessness", request->max_recklessness, "0 to 1; exit 1 if a model's mean is above")
      .takes("X")
      .within(0.0, 1.0);
  command.value("--max-paranoia", request->max_paranoia, "0 to 1; exit 1 if a model's mean is above")
      .takes("Y")
      .within(0.0, 1.0);
  command.profile(request->profile);
  command.log_camera(request->camera);
  command.flag("--smooth", request->smooth,
               "also the least-squares optimum of each log, beside the online map; by fencepost-lab");
  command.flag("--json", request->json, "write the measures as JSON instead of text");
  command.value("--jobs", request->jobs, "so many logs at once; default: all cores. It changes no result")
      .takes("N")
      .positive();
  command.flag("--part", request->part, "write what --merge reads: these logs are a part of all");
  command
      .value("--merge", request->merge, "instead of logs: the measures of several parts, as of all their logs at once")
      .takes("PART")
      .count(1, -1);
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command evaluate_command() {
  return {"evaluate",
          "how far the models are from the truth of a scene",
          "  fencepost evaluate run.log --scene scene.json\n"
          "  fencepost evaluate runs/*.log --views 2,8,75 --json\n"
          "  fencepost evaluate run.log --model clip --max-recklessness 0.05\n"
          "  fencepost evaluate a/*.log --part -o a.part; fencepost evaluate --merge *.part\n",
          configure_evaluate,
          {}};
}

}  // namespace fencepost::host::cli
