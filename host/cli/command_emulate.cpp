#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/emulate_run.hpp"

namespace fencepost::host::cli {
namespace {

Action configure_emulate(Options command) {
  const auto request = std::make_shared<EmulateRequest>();
  command
      .positional("DEVICE... SCENE|LOG", request->words,
                  "devices, each KIND[:PLACE][,option=value...], then a scene (JSON) or a log; - is standard input; "
                  "fencepost devices lists the kinds")
      .required();
  command.value("--link", request->links, "a link with a stable name to the pty; once for each device, in their order")
      .takes("PATH")
      .one_word();
  command.value("--listen", request->listens, "a TCP port instead of a pty; port 0: any free one")
      .takes("[HOST:]PORT")
      .one_word();
  command
      .value("--fault", request->faults,
             "of drop=P,corrupt=P,stall=P:S,late=P:S,reboot=S,unplug=S:S; of one device: DEVICE:drop=P,...")
      .takes("FAULTS")
      .one_word();
  command.value("--seed", request->seed, "another one gives other faults; default: 1").takes("N");
  command.value("--baud", request->baud, "of every line; 0: as fast as it goes; default: each device's own").takes("N");
  command.value("--speed", request->speed, "of the scene; default: 1").takes("X").positive();
  command.value("--delay", request->delay, "begin at the latest after so many seconds, whether or not a host is there")
      .takes("S")
      .not_negative();
  command.value("--seconds", request->seconds, "end so long after the beginning").takes("S").positive();
  command.flag("--loop", request->loop, "from the front again instead of ending");
  command.value("--camera", request->camera, "a file with an FPCAM line, or a scene: for logs without FPCAM")
      .takes("FILE");
  command.flag("-v,--verbose", request->verbose, "every command and reply, in hex and words");
  return [request] { return emulate(*request); };
}

}  // namespace

Command emulate_command() {
  return {"emulate",
          "a camera or wheel base on a pty or TCP port, without hardware",
          "  fencepost emulate pixy2 scene.json --link /tmp/pixy2\n"
          "  fencepost emulate pixy2:/tmp/pixy2 create2:/tmp/create scene.json --fault drop=0.001,unplug=20:3\n"
          "  fencepost emulate cmucam4:tcp:7000 run.log --verbose\n",
          configure_emulate,
          {}};
}

}  // namespace fencepost::host::cli
