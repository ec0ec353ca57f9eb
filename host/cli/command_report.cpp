#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"

namespace fencepost::host::cli {
namespace {

struct ReportRequest {
  std::string log;
  std::string scene;
  std::string camera;
  std::string output;
  ReplayOptions options;
};

/// "logs/run.log" is "run": the report goes into the current folder.
std::string default_output(const std::string& log) {
  if (log == "-") return "fencepost-report.html";
  return std::filesystem::path(log).stem().string() + ".html";
}

Exit run(ReportRequest request) {
  if ((request.log == "-") + (request.scene == "-") + (request.camera == "-") > 1) {
    throw Failure(Exit::kUsage, "only one of LOG, --scene and --camera can be standard input");
  }
  std::optional<Scene> truth;
  if (!request.scene.empty()) truth = read_scene(request.scene);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  const ReplayOutcome outcome = replay_file(request.log, request.options);

  const std::string output = request.output.empty() ? default_output(request.log) : request.output;
  const std::string title =
      request.log == "-" ? input_name("-") : std::filesystem::path(request.log).filename().string();
  write_output(output, write_report(outcome.result, truth, {title, "fencepost " FENCEPOST_VERSION}));
  say_what_was_left_out(outcome);
  if (!is_standard_output(output)) say("wrote " + output + "; open it in a browser");
  return Exit::kDone;
}

Action configure_report(CLI::App& app) {
  const auto request = std::make_shared<ReportRequest>();
  app.add_option("LOG", request->log, "a recorded stream; - is standard input")->required();
  app.add_option("--scene", request->scene, "the truth: drawn hatched, and every model is measured against it")
      ->type_name("SCENE");
  app.add_option("--profile", request->options.profile, "capacities of the robot; default: the log's, else full")
      ->check(CLI::IsMember({"micro", "small", "full"}));
  app.add_option("--camera", request->camera,
                 "a file with an FPCAM line, a scene, or its \"camera\": for logs without FPCAM")
      ->type_name("FILE");
  app.add_option("-o,--output", request->output, "default: the log's name with .html, in the current folder")
      ->type_name("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command report_command() {
  return {"report",
          "a picture of a run as one HTML file",
          "  fencepost report run.log\n"
          "  fencepost report approach.log --scene approach.json -o approach.html\n",
          configure_report,
          {}};
}

}  // namespace fencepost::host::cli
