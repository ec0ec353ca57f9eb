#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/lab.hpp"

namespace fencepost::host::cli {
namespace {

Action configure_smooth(Options command) {
  const auto request = std::make_shared<SmoothRequest>();
  command.positional("LOG", request->log, "a recorded stream; - is standard input").required();
  command.flag("--calibrate", request->calibrate, "focal length, yaw, pitch, latency and mount are estimated, too");
  command.value("--from", request->from, "s, stream time; earlier records are not used").takes("T");
  command.value("--to", request->to, "s, stream time; later records are not used").takes("T");
  command.profile(request->profile, "capacities of the robot that it is compared with; default: full");
  command.log_camera(request->camera);
  command.value("--report", request->report, "the optimum's map and path as one HTML file, the online outlines in it")
      .takes("FILE");
  command.flag("--json", request->json, "write the result document of the optimum instead of text");
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
  return [request] { return run_smooth(*request); };
}

}  // namespace

Command smooth_command() {
  return {"smooth",
          "the best map and path that a log allows, by least squares over all of it",
          "  fencepost smooth run.log\n"
          "  fencepost smooth run.log --report smoothed.html\n"
          "  fencepost smooth run.log --calibrate --json\n",
          configure_smooth,
          {},
          true};
}

}  // namespace fencepost::host::cli
