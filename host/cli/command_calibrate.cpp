#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/lab.hpp"

namespace fencepost::host::cli {
namespace {

void add_outputs(Options command, const std::shared_ptr<CalibrateRequest>& request) {
  command.value("--write-camera", request->write_camera, "the $FPCAM line, as the console and --camera take it")
      .takes("FILE");
  command.value("--write-robot", request->write_robot, "a robot file, as run --robot takes it").takes("FILE");
  command.value("--picture", request->picture, "an SVG of before and after").takes("FILE");
  command.flag("--json", request->json, "write the result as JSON instead of text");
  command.value("-o,--output", request->output, "where to write; default: standard output").takes("FILE");
}

Action configure_calibrate(Options command) {
  const auto request = std::make_shared<CalibrateRequest>();
  command.positional("LOG", request->log, "a recorded stream; - is standard input").required();
  command.value("--size", request->sizes, "how wide a block is, m: its diameter, or AxB")
      .takes("NAME=D|AxB")
      .repeated();
  command.value("--distance", request->distances, "how far apart two blocks are, middle to middle, m")
      .takes("NAME,NAME=D")
      .repeated();
  command.value("--from", request->from, "s, stream time; earlier records are not used").takes("T");
  command.value("--to", request->to, "s, stream time; later records are not used").takes("T");
  command.log_camera(request->camera);
  command.value("--robot", request->robot, "the robot file whose other numbers --write-robot keeps").takes("FILE");
  add_outputs(command, request);
  return [request] { return run_calibrate(*request); };
}

}  // namespace

Command calibrate_command() {
  return {"calibrate",
          "camera and wheels of a robot from a log of a short drive",
          "  fencepost calibrate run.log\n"
          "  fencepost calibrate run.log --size red=0.05 --picture calibration.svg\n"
          "  fencepost calibrate run.log --robot robot.json --write-robot calibrated.json\n",
          configure_calibrate,
          {},
          true};
}

}  // namespace fencepost::host::cli
