#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/share.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"
#include "host/web/page.hpp"

namespace fencepost::host::cli {
namespace {

struct ReportRequest {
  std::string log;
  std::string scene;
  std::string camera;
  std::string output;
  bool page = false;
  ReplayOptions options;
};

/// "logs/run.log" is "run": the report goes into the current folder.
std::string default_output(const std::string& log) {
  if (log == "-") return "fencepost-report.html";
  return std::filesystem::path(log).stem().string() + ".html";
}

std::string title_of(const std::string& log) {
  return log == "-" ? input_name("-") : std::filesystem::path(log).filename().string();
}

void write(const ReportRequest& request, const std::string& html) {
  const std::string output = request.output.empty() ? default_output(request.log) : request.output;
  write_output(output, html);
  if (!is_standard_output(output)) say("wrote " + output + "; open it in a browser");
}

// The page replays the log itself, as it is: what the command line can set it cannot.
Exit write_page(const ReportRequest& request) {
  if (!request.camera.empty() || !request.options.profile.empty()) {
    throw Failure(Exit::kUsage, "--page replays the log as it is; leave out --camera and --profile");
  }
  if (request.scene == "-") throw Failure(Exit::kUsage, "with --page the scene has to be a file");
  GivenLog given{title_of(request.log), read_input(request.log), std::nullopt};
  if (!request.scene.empty()) {
    given.scene = read_input(request.scene);
    read_scene(request.scene);  // says what is wrong with it
  }
  const std::string page = find_page();
  const std::optional<std::string> html = page_with(read_input(page), given);
  if (!html) throw Failure(Exit::kUnreadable, page + " is not the page of this version; install again");
  write(request, *html);
  return Exit::kDone;
}

Exit run(ReportRequest request) {
  if ((request.log == "-") + (request.scene == "-") + (request.camera == "-") > 1) {
    throw Failure(Exit::kUsage, "only one of LOG, --scene and --camera can be standard input");
  }
  if (request.page) return write_page(request);
  std::optional<Scene> truth;
  if (!request.scene.empty()) truth = read_scene(request.scene);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  const ReplayOutcome outcome = replay_file(request.log, request.options);

  write(request, write_report(outcome.result, truth, {title_of(request.log), "fencepost " FENCEPOST_VERSION}));
  say_what_was_left_out(outcome);
  return Exit::kDone;
}

Action configure_report(CLI::App& app) {
  const auto request = std::make_shared<ReportRequest>();
  app.add_option("LOG", request->log, "a recorded stream; - is standard input")->required();
  app.add_option("--scene", request->scene, "the truth: drawn hatched, and every model is measured against it")
      ->type_name("SCENE");
  app.add_flag("--page", request->page, "the page with a time slider instead: it replays the log itself, offline");
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
          "  fencepost report approach.log --scene approach.json -o approach.html\n"
          "  fencepost report run.log --page\n",
          configure_report,
          {}};
}

}  // namespace fencepost::host::cli
