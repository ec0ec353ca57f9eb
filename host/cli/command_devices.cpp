#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/describe.hpp"
#include "host/cli/files.hpp"
#include "host/cli/terminal.hpp"
#include "host/devices/catalogue.hpp"
#include "host/devices/tables.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host::cli {
namespace {

using devices::Use;

std::vector<std::string> kinds_known() {
  std::vector<std::string> names;
  for (const devices::Row& row : devices::catalogue()) names.emplace_back(*row.name);
  return names;
}

Exit list_devices(const std::vector<std::string>& kinds) {
  const std::vector<std::string> known = kinds_known();
  for (const std::string& kind : kinds) {
    if (std::ranges::find(known, kind) != known.end()) continue;
    throw Failure(Exit::kUsage, fmt::format("no device \"{}\"{}", kind, guess_among(known, kind, "fencepost devices")));
  }
  std::string text;
  const auto add = [&](std::string_view heading, Use use) {
    const std::string lines = devices::help_for(use, kinds);
    if (!lines.empty()) text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", heading, lines);
  };
  add("Cameras of run and record, KIND:PLACE[,option=value...]:", Use::kCamera);
  add("Odometry of run and record, likewise:", Use::kOdometry);
  add("Devices of emulate, KIND[:PLACE][,option=value...]. PLACE is pty (or nothing), a path for a link to the pty, "
      "tcp:[HOST:]PORT, or for can an interface:",
      Use::kEmulated);
  write_output("-", wrapped(text, columns_of_stdout()));
  return Exit::kDone;
}

}  // namespace

Command devices_command() {
  return {"devices",
          "the cameras and wheels that run, record and emulate know",
          "  fencepost devices\n"
          "  fencepost devices pixy2 create2\n",
          [](Options command) -> Action {
            const auto kinds = std::make_shared<std::vector<std::string>>();
            command.positional("KIND", *kinds, "of these alone; default: of all");
            return [kinds] { return list_devices(*kinds); };
          },
          {}};
}

}  // namespace fencepost::host::cli
