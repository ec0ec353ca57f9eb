#include "host/cli/help.hpp"

#include <fmt/format.h>

#include "host/cli/command.hpp"

namespace fencepost::host::cli {

std::string overview() {
  std::string text =
      "Usage: fencepost COMMAND [OPTIONS]\n\n"
      "Obstacle maps and alerts from coloured blobs and odometry: the robot's own loop, at the desk.\n\n"
      "Commands:\n";
  for (const Command& command : commands()) {
    text += fmt::format("  {:<11}  {}\n", command.name + (command.by_lab ? " *" : ""), command.summary);
  }
  return text +
         "\nOptions:\n"
         "  -h,--help     this help; after a command, that command's\n"
         "  -V,--version  the version\n"
         "\n* by a second program, fencepost-lab, which not every installation has\n"
         "Data goes to standard output, messages to standard error; - is standard input or output.\n"
         "Exit codes: 0 done, 1 a check failed, 2 usage, 3 unreadable input, 4 device or output, 130 interrupted.\n"
         "\nExamples:\n"
         "  fencepost demo\n"
         "  fencepost replay run.log\n"
         "  fencepost report run.log -o run.html\n";
}

}  // namespace fencepost::host::cli
