#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "host/cli/alert_spool.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/page_file.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/report_logs.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"
#include "host/result/thinned.hpp"
#include "host/scene/load.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

struct ReportRequest {
  std::vector<std::string> logs;
  std::vector<std::string> scenes;
  std::string camera;
  std::string output;
  bool still = false;
  bool whole = false;
  ReplayOptions options;
};

/// The page, and remarks for standard error.
struct Report {
  std::string html;
  std::vector<std::string> notes;
  Exit exit = Exit::kDone;
};

/// "logs/run.log" is "run": the report goes into the current folder.
std::string default_output(const std::vector<std::string>& logs) {
  if (logs.size() > 1 || logs.front() == "-") return "fencepost-report.html";
  return std::filesystem::path(logs.front()).stem().string() + ".html";
}

Scene parsed_scene(const std::string& text, const std::string& path) {
  const LoadedScene scene = parse_scene(text, input_name(path));
  if (!scene.ok()) throw Failure(Exit::kUnreadable, scene.error().message());
  return *scene;
}

std::string thinned_to_fit(const std::string& said) {
  return fmt::format("thinned to fit {} MB: {}", kMaxReport / 1'000'000, said);
}

/// Without script, of one log.
Report still_report(const ReportRequest& request) {
  constexpr std::size_t kMaxAlerts = 2'500;  // in a table and a drawing: half of their capacity
  std::optional<Scene> truth;
  if (!request.scenes.empty()) truth = parsed_scene(read_input(request.scenes.front()), request.scenes.front());
  AlertSpool alerts;
  ReplayOptions options = request.options;
  options.alerts = &alerts;
  ReplayOutcome outcome = replay_file(request.logs.front(), options);
  ThinnedAlerts kept = thin_alerts([&](const auto& visit) { alerts.each(visit); }, kMaxAlerts);
  outcome.result.alerts = std::move(kept.kept);
  Report report;
  ReportOptions shown{title_of(request.logs.front()), "fencepost " FENCEPOST_VERSION};
  if (outcome.result.alerts.size() < kept.all) {
    const std::string said = thinned_to_fit(
        fmt::format("{} of {} alerts, of those that follow each other faster than can be drawn the worst",
                    outcome.result.alerts.size(), kept.all));
    shown.note = said + "; all of them: fencepost replay";
    report.notes.push_back(said);
  }
  report.html = write_report(outcome.result, truth, shown);
  for (const std::string& line : what_was_left_out(outcome)) report.notes.push_back(line);
  return report;
}

// The page shows one that cannot be replayed with its reason, beside others that can. One that cannot be read is left
// out of it.
Report page_report(const ReportRequest& request) {
  ReportInputs inputs{request.logs, {}, request.options, request.whole};
  inputs.scenes.resize(request.logs.size());
  for (std::size_t i = 0; i < request.scenes.size(); ++i) {
    inputs.scenes[i] = read_input(request.scenes[i]);
    parsed_scene(*inputs.scenes[i], request.scenes[i]);
  }
  std::vector<ReportedLog> logs = read_report_logs(inputs, empty_page_size());
  const auto unreadable = [](const ReportedLog& log) { return log.failure || log.outcome.unreadable; };
  if (std::ranges::all_of(logs, unreadable)) {
    if (logs.front().failure) throw *logs.front().failure;
    throw Failure(Exit::kUnreadable, logs.front().outcome.unreadable->message);
  }
  Report report;
  std::vector<GivenLog> given;
  for (ReportedLog& log : logs) {
    if (log.failure) {
      report.notes.push_back(std::string("left out: ") + log.failure->what());
      report.exit = log.failure->code();
      continue;
    }
    const std::string name = logs.size() > 1 ? log.given.name : "";
    if (log.outcome.unreadable) report.notes.push_back(log.outcome.unreadable->message);
    if (!log.thinned.empty()) {
      report.notes.push_back((name.empty() ? "" : name + ": ") + thinned_to_fit(log.thinned) +
                             "; all of it: fencepost report --whole");
    }
    for (const std::string& line : what_was_left_out(log.outcome, name)) report.notes.push_back(line);
    given.push_back(std::move(log.given));
  }
  report.html = page_of_logs(given, request.options.profile);
  return report;
}

void check(const ReportRequest& request) {
  const auto from_stdin =
      std::ranges::count(request.logs, "-") + std::ranges::count(request.scenes, "-") + (request.camera == "-" ? 1 : 0);
  if (from_stdin > 1) {
    throw Failure(Exit::kUsage, "only one of LOG, --scene and --camera can be standard input");
  }
  if (!request.scenes.empty() && request.scenes.size() != request.logs.size()) {
    throw Failure(Exit::kUsage,
                  fmt::format("{} and {}; give one --scene for each log, in the same order",
                              plural(request.logs.size(), "log"), plural(request.scenes.size(), "scene")));
  }
  if (!request.still) return;
  if (request.whole) throw Failure(Exit::kUsage, "--whole is of the page, which replays the log; leave out --static");
  if (request.logs.size() > 1) {
    throw Failure(Exit::kUsage, "--static shows one log; without it the page shows several side by side");
  }
}

Exit run(ReportRequest request) {
  check(request);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  const Report report = request.still ? still_report(request) : page_report(request);
  const std::string output = request.output.empty() ? default_output(request.logs) : request.output;
  write_output(output, report.html);
  if (!is_standard_output(output)) say("wrote " + output + "; open it in a browser");
  for (const std::string& note : report.notes) say(note);
  if (report.html.size() > kMaxReport && !request.whole) {
    say(fmt::format("it has {:.1f} MB, more than {}: give fewer logs, or a smaller scene",
                    static_cast<double>(report.html.size()) / 1e6, kMaxReport / 1'000'000));
  }
  return report.exit;
}

Action configure_report(Options command) {
  const auto request = std::make_shared<ReportRequest>();
  command.positional("LOG", request->logs, "recorded streams, side by side; - is standard input").required();
  command.value("--scene", request->scenes, "the truth, drawn hatched: one for each LOG, in the same order")
      .takes("SCENE")
      .repeated();
  command.flag("--static", request->still,
               "a picture without any script instead, for paper, mail and browsers without WebAssembly: "
               "one log, and with --scene every model measured against the truth");
  command.flag(
      "--whole", request->whole,
      "each log with every byte, however large the page becomes; default: at most 2 MB, of longer logs as much as "
      "can be seen");
  command.profile(request->options.profile);
  command.log_camera(request->camera);
  command
      .value("-o,--output", request->output,
             "default: the log's name with .html, in the current folder; of several fencepost-report.html")
      .takes("FILE");
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
