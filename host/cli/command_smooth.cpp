#include <filesystem>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"
#include "host/smooth/smooth.hpp"
#include "host/smooth/smooth_text.hpp"

namespace fencepost::host::cli {
namespace {

struct SmoothRequest {
  std::string log;
  std::string camera;
  std::string report;
  std::string output = "-";
  bool json = false;
  SmoothOptions options;
};

void check_usage(const SmoothRequest& request) {
  if (request.options.from && request.options.to && *request.options.from > *request.options.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  if (request.log == "-" && request.camera == "-") {
    throw Failure(Exit::kUsage, "LOG and --camera cannot both be standard input; put one into a file");
  }
  if (is_standard_output(request.output) && is_standard_output(request.report)) {
    throw Failure(Exit::kUsage, "the result and --report cannot both be standard output; name a file with -o");
  }
}

Exit run(SmoothRequest request) {
  check_usage(request);
  if (!request.camera.empty()) request.options.camera = read_camera(request.camera);
  std::optional<Progress> progress("smoothing");
  request.options.progress = [&](double share) { progress->at(share, 1); };
  const SmoothOutcome outcome = smooth(read_log(request.log), input_name(request.log), request.options);
  progress.reset();
  if (outcome.replay.unreadable) throw Failure(Exit::kUnreadable, outcome.replay.unreadable->message);
  if (!outcome.smoothed) throw Failure(Exit::kUnreadable, outcome.refusal);
  const Smoothed& smoothed = *outcome.smoothed;
  if (!request.report.empty()) {
    const std::string title =
        request.log == "-" ? input_name("-") : std::filesystem::path(request.log).filename().string();
    write_output(request.report,
                 write_report(smoothed.optimum, std::nullopt, {title + ", smoothed", "fencepost " FENCEPOST_VERSION}));
  }
  write_output(request.output, request.json ? smooth_json(smoothed) : smooth_text(smoothed, input_name(request.log)));
  say_what_was_left_out(outcome.replay);
  for (const std::string& note : smoothed.notes) say(note);
  return Exit::kDone;
}

Action configure_smooth(CLI::App& app) {
  const auto request = std::make_shared<SmoothRequest>();
  app.add_option("LOG", request->log, "a recorded stream; - is standard input")->required();
  app.add_flag("--calibrate", request->options.calibrate,
               "focal length, yaw, pitch, latency and mount are estimated, too");
  app.add_option("--from", request->options.from, "s, stream time; earlier records are not used")->type_name("T");
  app.add_option("--to", request->options.to, "s, stream time; later records are not used")->type_name("T");
  app.add_option("--profile", request->options.profile,
                 "capacities of the robot that it is compared with; default: full")
      ->check(CLI::IsMember({"micro", "small", "full"}));
  app.add_option("--camera", request->camera,
                 "a file with an FPCAM line, a scene, or its \"camera\": for logs without FPCAM")
      ->type_name("FILE");
  app.add_option("--report", request->report, "the optimum's map and path as one HTML file, the online outlines in it")
      ->type_name("FILE");
  app.add_flag("--json", request->json, "write the result document of the optimum instead of text");
  app.add_option("-o,--output", request->output, "where to write; default: standard output")->type_name("FILE");
  return [request] { return run(*request); };
}

}  // namespace

Command smooth_command() {
  return {"smooth",
          "the best map and path that a log allows, by least squares over all of it",
          "  fencepost smooth run.log\n"
          "  fencepost smooth run.log --report smoothed.html\n"
          "  fencepost smooth run.log --calibrate --json\n",
          configure_smooth,
          {}};
}

}  // namespace fencepost::host::cli
