#include "host/simulate/simulate.hpp"

#include <fmt/format.h>

#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"

namespace fencepost::host::cli {
namespace {

struct SimulateRequest {
  std::string scene;
  std::string output = "-";
};

void say_summary(const SimulationSummary& summary) {
  say(fmt::format("{:.1f} s: {} frames with {} blobs, {} odometry samples", summary.duration, summary.frames,
                  summary.blobs, summary.odometry));
  if (summary.frames_dropped > 0) say(fmt::format("{} frames dropped by the scene's noise", summary.frames_dropped));
  if (summary.blobs_dropped > 0) say(fmt::format("{} blobs beyond the camera's max_blobs", summary.blobs_dropped));
  if (summary.frames_inside > 0) {
    say(fmt::format("{} frames were exposed inside an object; move the path or the object", summary.frames_inside));
  }
}

Exit run(const SimulateRequest& request) {
  const Scene scene = read_scene(request.scene);
  std::string log;
  const auto summary = simulate(scene, [&](std::string_view line) { log += line; });
  if (!summary.ok()) throw Failure(Exit::kUnreadable, input_name(request.scene) + ": " + summary.error());
  write_output(request.output, log);
  say_summary(*summary);
  return Exit::kDone;
}

Action configure_simulate(Options command) {
  const auto request = std::make_shared<SimulateRequest>();
  command.positional("SCENE", request->scene, "a scene file (JSON); - is standard input").required();
  command.value("-o,--output", request->output, "where to write the log; default: standard output").takes("LOG");
  return [request] { return run(*request); };
}

}  // namespace

Command simulate_command() {
  return {"simulate",
          "the record stream of a robot in a scene",
          "  fencepost simulate scene.json -o scene.log\n"
          "  fencepost simulate scene.json | fencepost replay -\n",
          configure_simulate,
          {}};
}

}  // namespace fencepost::host::cli
