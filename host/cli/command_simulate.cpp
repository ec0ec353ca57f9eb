#include "host/simulate/simulate.hpp"

#include <fmt/format.h>

#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

struct SimulateRequest {
  std::string scene;
  std::string output = "-";
};

void say_summary(const SimulationSummary& summary) {
  say(fmt::format("{:.1f} s: {} with {}, {}", summary.duration, plural(summary.frames, "frame"),
                  plural(summary.blobs, "blob"), plural(summary.odometry, "odometry sample")));
  if (summary.frames_dropped > 0) say(plural(summary.frames_dropped, "frame") + " dropped by the scene's noise");
  if (summary.blobs_dropped > 0) say(plural(summary.blobs_dropped, "blob") + " beyond the camera's max_blobs");
  if (summary.frames_inside > 0) {
    say(plural(summary.frames_inside, "frame") + " exposed inside an object; move the path or the object");
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
