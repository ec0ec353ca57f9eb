#include <filesystem>
#include <optional>

#include "host/cli/files.hpp"
#include "host/cli/lab.hpp"
#include "host/cli/log_input.hpp"
#include "host/cli/progress.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/report/report.hpp"
#include "host/smooth/smooth.hpp"
#include "host/smooth/smooth_text.hpp"

namespace fencepost::host::cli {
namespace {

void check_usage(const SmoothRequest& request) {
  if (request.from && request.to && *request.from > *request.to) {
    throw Failure(Exit::kUsage, "--from is later than --to; swap them");
  }
  if (request.log == "-" && request.camera == "-") {
    throw Failure(Exit::kUsage, "LOG and --camera cannot both be standard input; put one into a file");
  }
  if (is_standard_output(request.output) && is_standard_output(request.report)) {
    throw Failure(Exit::kUsage, "the result and --report cannot both be standard output; name a file with -o");
  }
}

}  // namespace

Exit run_smooth(const SmoothRequest& request) {
  check_usage(request);
  SmoothOptions options;
  options.profile = request.profile;
  options.from = request.from;
  options.to = request.to;
  options.calibrate = request.calibrate;
  if (!request.camera.empty()) options.camera = read_camera(request.camera);
  std::optional<Progress> progress(std::in_place, "smoothing", OffTerminal::kLines);
  options.progress = [&](double share) { progress->at(share, 1); };
  const SmoothOutcome outcome = smooth(read_log(request.log), input_name(request.log), options);
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

}  // namespace fencepost::host::cli
