#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/positive.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/evaluate/evaluate.hpp"
#include "host/evaluate/evaluation_json.hpp"
#include "host/evaluate/evaluation_text.hpp"
#include "host/smooth/truth_par.hpp"

namespace fencepost::host::cli {
namespace {

struct EvaluateRequest {
  std::vector<std::string> logs;
  std::vector<std::string> scenes;
  std::string camera;
  std::vector<std::string> models;
  std::optional<double> max_recklessness;
  std::optional<double> max_paranoia;
  bool json = false;
  bool smooth = false;
  std::string output = "-";
  EvaluateOptions options;
};

/// "logs/run.log" has its scene in "logs/run.json".
std::string scene_beside(const std::string& log) {
  if (log == "-") throw Failure(Exit::kUsage, "a log from standard input needs --scene SCENE");
  const std::string scene = std::filesystem::path(log).replace_extension(".json").string();
  std::error_code error;
  if (std::filesystem::exists(scene, error)) return scene;
  if (error)
    throw Failure(Exit::kUnreadable,
                  "cannot look for the scene " + scene + ": " + error.message() + "; name it with --scene SCENE");
  throw Failure(Exit::kUnreadable, log + ": no scene " + scene + " beside it; name it with --scene SCENE");
}

void pair_up(EvaluateRequest& request) {
  if (request.scenes.empty()) {
    for (const std::string& log : request.logs) request.scenes.push_back(scene_beside(log));
  }
  if (request.scenes.size() != request.logs.size()) {
    throw Failure(Exit::kUsage, fmt::format("{} logs and {} scenes; give one --scene for each log, in the same order, "
                                            "or none at all if each X.log has its X.json beside it",
                                            request.logs.size(), request.scenes.size()));
  }
  const auto inputs = std::count(request.logs.begin(), request.logs.end(), "-") +
                      std::count(request.scenes.begin(), request.scenes.end(), "-") + (request.camera == "-" ? 1 : 0);
  if (inputs > 1) throw Failure(Exit::kUsage, "only one of the logs, scenes and --camera can be standard input");
}

template <class Entry, class Name>
void keep_named(std::vector<Entry>& entries, const std::vector<std::string>& names, Name name) {
  entries.erase(std::remove_if(entries.begin(), entries.end(),
                               [&](const Entry& entry) {
                                 return std::find(names.begin(), names.end(), name(entry)) == names.end();
                               }),
                entries.end());
}

/// Leaves the other models out.
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

Evaluation evaluate_pair(const EvaluateRequest& request, std::size_t pair) {
  const Scene scene = read_scene(request.scenes[pair]);
  const std::string name = input_name(request.logs[pair]);
  EvaluateOutcome outcome = evaluate(read_input(request.logs[pair]), name, scene, request.options);
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  say_what_was_left_out(outcome.replay, request.logs.size() > 1 ? name : "");
  outcome.evaluation.log = name;
  outcome.evaluation.scene = input_name(request.scenes[pair]);
  if (!request.models.empty()) keep_models(outcome.evaluation, request.models);
  return std::move(outcome.evaluation);
}

SmoothEvaluation smooth_pair(const EvaluateRequest& request, std::size_t pair) {
  if (request.logs[pair] == "-" || request.scenes[pair] == "-") {
    throw Failure(Exit::kUsage, "--smooth reads logs and scenes twice; put standard input into a file");
  }
  SmoothOptions options;
  options.profile = request.options.profile;
  options.camera = request.options.camera;
  const std::string name = input_name(request.logs[pair]);
  const SmoothOutcome outcome = smooth(read_input(request.logs[pair]), name, options);
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  if (!outcome.smoothed) throw Failure(Exit::kUnreadable, outcome.refusal);
  return evaluate_smoothed(*outcome.smoothed, read_scene(request.scenes[pair]), name);
}

std::vector<SmoothEvaluation> smooth_all(const EvaluateRequest& request) {
  std::vector<SmoothEvaluation> evaluations;
  for (std::size_t i = 0; i < request.logs.size(); ++i) evaluations.push_back(smooth_pair(request, i));
  return evaluations;
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

Exit run(EvaluateRequest request) {
  pair_up(request);
  std::vector<std::uint32_t>& views = request.options.views;
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);

  std::vector<Evaluation> evaluations;
  for (std::size_t i = 0; i < request.logs.size(); ++i) evaluations.push_back(evaluate_pair(request, i));
  const Summary summary = summarise(evaluations, views);
  std::string text = request.json ? to_json(evaluations, summary, views) : evaluation_text(evaluations, summary, views);
  if (request.smooth) {
    const std::vector<SmoothEvaluation> smoothed = smooth_all(request);
    text = request.json ? with_smooth_json(text, smoothed) : text + smooth_evaluation_text(smoothed);
  }
  write_output(request.output, text);
  return judge(request, summary);
}

Action configure_evaluate(CLI::App& app) {
  const auto request = std::make_shared<EvaluateRequest>();
  app.add_option("LOG", request->logs, "recorded streams; - is standard input")->required();
  app.add_option("--scene", request->scenes, "the truth, one for each LOG; default: X.json beside X.log")
      ->type_name("SCENE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_option("--views", request->options.views, "measure where an object has so many views; default: 2,4,8,18,75")
      ->type_name("N,N,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(positive());
  app.add_option("--model", request->models, "only these models; the bounds then hold for them only")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--max-recklessness", request->max_recklessness, "0 to 1; exit 1 if a model's mean is above")
      ->type_name("X")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--max-paranoia", request->max_paranoia, "0 to 1; exit 1 if a model's mean is above")
      ->type_name("Y")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--profile", request->options.profile, "capacities of the robot; default: the log's, else full")
      ->check(CLI::IsMember({"micro", "small", "full"}));
  app.add_option("--camera", request->camera,
                 "a file with an FPCAM line, a scene, or its \"camera\": for logs without FPCAM")
      ->type_name("FILE");
  app.add_flag("--smooth", request->smooth, "also the least-squares optimum of each log, beside the online map");
  app.add_flag("--json", request->json, "write the measures as JSON instead of text");
  app.add_option("-o,--output", request->output, "where to write; default: standard output")->type_name("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command evaluate_command() {
  return {"evaluate",
          "how far the models are from the truth of a scene",
          "  fencepost evaluate run.log --scene scene.json\n"
          "  fencepost evaluate runs/*.log --views 2,8,75 --json\n"
          "  fencepost evaluate run.log --model clip --max-recklessness 0.05\n",
          configure_evaluate,
          {}};
}

}  // namespace fencepost::host::cli
