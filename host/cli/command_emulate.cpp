#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/emulate_run.hpp"
#include "host/cli/positive.hpp"
#include "host/devices/tables.hpp"

namespace fencepost::host::cli {
namespace {

Action configure_emulate(CLI::App& app) {
  const auto request = std::make_shared<EmulateRequest>();
  app.add_option("DEVICE... SCENE|LOG", request->words,
                 "devices, each KIND[:PLACE][,option=value...], then a scene (JSON) or a log; - is standard input")
      ->required();
  app.add_option("--link", request->links, "a link with a stable name to the pty; once for each device, in their order")
      ->type_name("PATH")
      ->allow_extra_args(false);
  app.add_option("--listen", request->listens, "a TCP port instead of a pty; port 0: any free one")
      ->type_name("[HOST:]PORT")
      ->allow_extra_args(false);
  app.add_option("--fault", request->faults,
                 "of drop=P,corrupt=P,stall=P:S,late=P:S,reboot=S,unplug=S:S; of one device: DEVICE:drop=P,...")
      ->type_name("FAULTS")
      ->allow_extra_args(false);
  app.add_option("--seed", request->seed, "another one gives other faults; default: 1")->type_name("N");
  app.add_option("--baud", request->baud, "of every line; 0: as fast as it goes; default: each device's own")
      ->type_name("N");
  app.add_option("--speed", request->speed, "of the scene; default: 1")->type_name("X")->check(positive());
  app.add_option("--delay", request->delay, "begin at the latest after so many seconds, whether or not a host is there")
      ->type_name("S")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seconds", request->seconds, "end so long after the beginning")->type_name("S")->check(positive());
  app.add_flag("--loop", request->loop, "from the front again instead of ending");
  app.add_option("--camera", request->camera, "a file with an FPCAM line, or a scene: for logs without FPCAM")
      ->type_name("FILE");
  app.add_flag("-v,--verbose", request->verbose, "every command and reply, in hex and words");
  return [request] { return emulate(*request); };
}

}  // namespace

Command emulate_command() {
  return {"emulate",
          "a camera or wheel base on a pty or TCP port, without hardware",
          "  fencepost emulate pixy2 scene.json --link /tmp/pixy2\n"
          "  fencepost emulate pixy2:/tmp/pixy2 create2:/tmp/create scene.json --fault drop=0.001,unplug=20:3\n"
          "  fencepost emulate cmucam4:tcp:7000 run.log --verbose\n\n"
          "Devices (PLACE: nothing or pty; a path, a link to the pty; tcp:[HOST:]PORT; of can an interface):\n" +
              devices::help_for(devices::Use::kEmulated),
          configure_emulate,
          {}};
}

}  // namespace fencepost::host::cli
