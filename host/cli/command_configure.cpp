#include <fmt/format.h>

#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/terminal.hpp"
#include "host/configure/configure.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

struct Request {
  std::string image;
  std::string camera;
  std::string lens;
  std::string odometry;
  std::string robot;
  std::string calibration;
  std::vector<std::string> settings;
  std::string output;
};

std::pair<std::string, std::string> setting_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Failure(Exit::kUsage, "--set " + text + " is no KEY=VALUE; write, for example, --set alert.stop=0.30");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

ConfigureRequest request_of(const Request& request) {
  ConfigureRequest wanted;
  for (const auto& [key, value] : {std::pair("camera", request.camera), std::pair("lens", request.lens),
                                   std::pair("odometry", request.odometry)}) {
    if (!value.empty()) wanted.settings.emplace_back(key, value);
  }
  for (const std::string& text : request.settings) wanted.settings.push_back(setting_in(text));
  wanted.robot = read_robot(request.robot);
  if (!request.calibration.empty()) wanted.calibration = read_camera(request.calibration);
  return wanted;
}

// Standard output gets the format of the input.
ImageFormat format_of(const Request& request, const ConfiguredImage& image) {
  const bool to_output = is_standard_output(request.output);
  const auto format = image_format(to_output ? request.image : request.output);
  const std::string& name = to_output ? request.image : request.output;
  if (!format) throw Failure(Exit::kUsage, name + ": its name has to end with .uf2, .hex, .bin, .dfu or .sav");
  if (image.cartridge != (*format == ImageFormat::kSave)) {
    throw Failure(Exit::kUsage,
                  image.cartridge
                      ? fmt::format("{} keeps its settings in the cartridge's memory: write {} to a "
                                    "file that ends with .sav, and put it beside the image",
                                    image.board, name)
                      : fmt::format("{}: only a cartridge has a .sav; {} takes the image itself", name, image.board));
  }
  if (*format == ImageFormat::kUf2 && !image.uf2) {
    throw Failure(Exit::kUsage, fmt::format("{}: {} takes no UF2 files; write .hex or .bin", name, image.board));
  }
  if (*format == ImageFormat::kDfu && !image.dfu) {
    throw Failure(Exit::kUsage, fmt::format("{}: {} takes no DFU files; write .hex or .bin", name, image.board));
  }
  return *format;
}

[[noreturn]] void refuse_image(const Request& request, const std::string& why) {
  throw Failure(Exit::kUnreadable,
                input_name(request.image) + ": " + why + "; share/doc/boards.md tells which to take");
}

Exit run(const Request& request) {
  const ConfigureRequest wanted = request_of(request);
  const auto image = read_image(read_input(request.image));
  if (!image.ok()) refuse_image(request, image.error());
  const auto configured = configure(*image, wanted);
  if (!configured.ok() && !can_be_configured(*image)) refuse_image(request, configured.error());
  if (!configured.ok()) throw Failure(Exit::kUsage, input_name(request.image) + ": " + configured.error());
  write_output(request.output, write_image(configured->memory, format_of(request, *configured)));
  say(fmt::format("{}, version {}: {} in {} of {} bytes", configured->board, configured->version,
                  plural(configured->configured.size(), "line"), configured->used, configured->room));
  for (const std::string& line : configured->configured) say("  " + line);
  return Exit::kDone;
}

Action configure_command_line(Options command) {
  const auto request = std::make_shared<Request>();
  command.positional("IMAGE", request->image, "a board's image: .uf2, .hex, .bin or .gba").required();
  command.value("--camera", request->camera, "which camera is connected, such as pixy2.1").takes("NAME");
  command.value("--lens", request->lens, "degrees that it sees across, where its lens is another; 0: as delivered")
      .takes("DEG");
  command.value("--odometry", request->odometry, "what tells how the wheels turn: console, encoders, create1, create2")
      .takes("NAME");
  command.value("--robot", request->robot, "the robot's numbers (JSON): camera mount, colours, wheels, settings")
      .takes("FILE");
  command
      .value("--calibration", request->calibration,
             "a file with an FPCAM line, or a scene: instead of the camera's own")
      .takes("FILE");
  command.value("--set", request->settings, "any other setting; may be repeated").takes("KEY=VALUE");
  command.value("-o,--output", request->output, "where to write it: .uf2, .hex, .bin or .dfu; .sav for a Game Boy")
      .takes("FILE")
      .required();
  return [request] { return run(*request); };
}

}  // namespace

Command configure_command() {
  return {"configure",
          "settings, calibration and colours into a board's image",
          "  fencepost configure fencepost-pico.uf2 --camera pixy2.1 --robot robot.json -o mine.uf2\n"
          "  fencepost configure fencepost-xrp.uf2 --camera huskylens_i2c --set alert.stop=0.30 -o mine.uf2\n",
          configure_command_line,
          {}};
}

}  // namespace fencepost::host::cli
