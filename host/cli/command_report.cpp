#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>

#include "firmware/record/encode.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/page_file.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"
#include "host/scene/load.hpp"
#include "host/web/page.hpp"

namespace fencepost::host::cli {
namespace {

struct ReportRequest {
  std::vector<std::string> logs;
  std::vector<std::string> scenes;
  std::string camera;
  std::string output;
  bool still = false;
  ReplayOptions options;
};

/// A log with its truth, and what its replay found.
struct Reported {
  GivenLog given;
  std::optional<Scene> truth;
  ReplayOutcome outcome;
};

/// "logs/run.log" is "run": the report goes into the current folder.
std::string default_output(const std::vector<std::string>& logs) {
  if (logs.size() > 1 || logs.front() == "-") return "fencepost-report.html";
  return std::filesystem::path(logs.front()).stem().string() + ".html";
}

std::string title_of(const std::string& log) {
  return log == "-" ? input_name("-") : std::filesystem::path(log).filename().string();
}

std::string line_of(const sensor::CameraIntrinsics& camera) {
  std::array<char, record::kMaxLine> line{};
  return {line.data(), record::encode(camera, line)};
}

Scene parsed_scene(const std::string& text, const std::string& path) {
  const LoadedScene scene = parse_scene(text, input_name(path));
  if (!scene.ok()) throw Failure(Exit::kUnreadable, scene.error().message());
  return *scene;
}

Reported report_of(const ReportRequest& request, std::size_t which) {
  const std::string& path = request.logs[which];
  Reported log{{title_of(path), {}, std::nullopt}, std::nullopt, {}};
  if (!request.scenes.empty()) {
    log.given.scene = read_input(request.scenes[which]);
    log.truth = parsed_scene(*log.given.scene, request.scenes[which]);
  }
  log.given.log = read_input(path);
  if (request.options.camera) log.given.log = with_calibration(log.given.log, line_of(*request.options.camera));
  log.outcome = replay(log.given.log, input_name(path), request.options);
  return log;
}

// The page shows one that cannot be replayed with its reason, beside others that can.
std::vector<Reported> reports_of(const ReportRequest& request) {
  std::vector<Reported> all;
  for (std::size_t i = 0; i < request.logs.size(); ++i) all.push_back(report_of(request, i));
  const auto unreadable = [](const Reported& log) { return log.outcome.unreadable.has_value(); };
  if (std::ranges::all_of(all, unreadable)) throw Failure(Exit::kUnreadable, all.front().outcome.unreadable->message);
  return all;
}

std::string html_of(const ReportRequest& request, const std::vector<Reported>& logs) {
  if (request.still) {
    const Reported& log = logs.front();
    return write_report(log.outcome.result, log.truth, {log.given.name, "fencepost " FENCEPOST_VERSION});
  }
  std::vector<GivenLog> given;
  for (const Reported& log : logs) given.push_back(log.given);
  return page_of_logs(given, request.options.profile);
}

void check(const ReportRequest& request) {
  const auto from_stdin =
      std::ranges::count(request.logs, "-") + std::ranges::count(request.scenes, "-") + (request.camera == "-" ? 1 : 0);
  if (from_stdin > 1) {
    throw Failure(Exit::kUsage, "only one of LOG, --scene and --camera can be standard input");
  }
  if (!request.scenes.empty() && request.scenes.size() != request.logs.size()) {
    throw Failure(Exit::kUsage, fmt::format("{} logs and {} scenes; give one --scene for each log, in the same order",
                                            request.logs.size(), request.scenes.size()));
  }
  if (!request.still) return;
  if (request.logs.size() > 1) {
    throw Failure(Exit::kUsage, "--static shows one log; without it the page shows several side by side");
  }
}

Exit run(ReportRequest request) {
  check(request);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  const std::vector<Reported> logs = reports_of(request);
  const std::string output = request.output.empty() ? default_output(request.logs) : request.output;
  write_output(output, html_of(request, logs));
  if (!is_standard_output(output)) say("wrote " + output + "; open it in a browser");
  for (const Reported& log : logs) {
    if (log.outcome.unreadable) say(log.outcome.unreadable->message);
    say_what_was_left_out(log.outcome, logs.size() > 1 ? log.given.name : "");
  }
  return Exit::kDone;
}

Action configure_report(CLI::App& app) {
  const auto request = std::make_shared<ReportRequest>();
  app.add_option("LOG", request->logs, "recorded streams, side by side; - is standard input")->required();
  app.add_option("--scene", request->scenes, "the truth, drawn hatched: one for each LOG, in the same order")
      ->type_name("SCENE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
  app.add_flag("--static", request->still,
               "a picture without any script instead, for paper, mail and browsers without WebAssembly: "
               "one log, and with --scene every model measured against the truth");
  app.add_option("--profile", request->options.profile, "capacities of the robot; default: the log's, else full")
      ->check(CLI::IsMember({"micro", "small", "full"}));
  app.add_option("--camera", request->camera,
                 "a file with an FPCAM line, a scene, or its \"camera\": for logs without FPCAM")
      ->type_name("FILE");
  app.add_option("-o,--output", request->output,
                 "default: the log's name with .html, in the current folder; of several fencepost-report.html")
      ->type_name("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command report_command() {
  return {"report",
          "a run as one HTML file: map, time slider, alerts, objects",
          "  fencepost report run.log\n"
          "  fencepost report approach.log --scene approach.json -o approach.html\n"
          "  fencepost report monday.log tuesday.log\n"
          "  fencepost report run.log --static\n",
          configure_report,
          {}};
}

}  // namespace fencepost::host::cli
