#include <fmt/format.h>

#include <memory>
#include <vector>

#include "host/cli/command.hpp"
#include "host/cli/describe.hpp"
#include "host/cli/files.hpp"
#include "host/cli/manual.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host::cli {
namespace {

struct HelpRequest {
  std::vector<std::string> words;
  bool roff = false;
  std::string pages;
};

std::string page_of(const CommandWords& command) {
  const std::string summary = command.path.size() == 1 ? kProgramSummary : command.text;
  return manual_page(command.name(), summary, FENCEPOST_VERSION, command.help);
}

Exit run(const CommandWords& program, const HelpRequest& request) {
  if (!request.pages.empty()) {
    for (const CommandWords* command : all_commands(program)) {
      write_output(fmt::format("{}/{}.1", request.pages, command->name('-')), page_of(*command));
    }
    return Exit::kDone;
  }
  const CommandWords& command = find_command(program, request.words);
  write_output("-", request.roff ? page_of(command) : wrapped(command.help, columns_of_stdout()));
  return Exit::kDone;
}

}  // namespace

Command help_command() {
  return {"help",
          "a command's help, as after --help",
          "  fencepost help\n"
          "  fencepost help import csv\n"
          "  fencepost help replay --roff | man -l -\n",
          [](Options command) -> Action {
            const auto request = std::make_shared<HelpRequest>();
            command.positional("COMMAND", request->words, "whose; default: what there is");
            command.flag("--roff", request->roff, "as a manual page");
            command.value("--pages", request->pages, "instead: all manual pages into a folder").takes("DIR");
            return [command, request] { return run(command.program(), *request); };
          },
          {}};
}

}  // namespace fencepost::host::cli
