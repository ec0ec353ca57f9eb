#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <vector>

#include "host/cli/command.hpp"
#include "host/cli/describe.hpp"
#include "host/cli/files.hpp"
#include "host/cli/manual.hpp"

namespace fencepost::host::cli {
namespace {

struct HelpRequest {
  std::vector<std::string> words;
  bool roff = false;
  std::string pages;
};

/// All manual pages, each by its command's name.
void write_pages(const CLI::App& command, std::vector<std::string> path, const std::string& folder) {
  path.push_back(command.get_name());
  const std::string name = fmt::format("{}", fmt::join(path, " "));
  const std::string summary = path.size() == 1 ? kProgramSummary : command.get_description();
  write_output(fmt::format("{}/{}.1", folder, fmt::join(path, "-")),
               manual_page(name, summary, FENCEPOST_VERSION, help_of(command)));
  for (const CLI::App* child : command.get_subcommands({})) write_pages(*child, path, folder);
}

Exit run(const CLI::App& program, const HelpRequest& request) {
  if (!request.pages.empty()) {
    write_pages(program, {}, request.pages);
    return Exit::kDone;
  }
  const CLI::App& command = find_command(program, request.words);
  std::string name = program.get_name();
  for (const std::string& word : request.words) name += " " + word;
  const std::string summary = request.words.empty() ? kProgramSummary : command.get_description();
  const std::string help = help_of(command);
  write_output("-", request.roff ? manual_page(name, summary, FENCEPOST_VERSION, help) : help);
  return Exit::kDone;
}

}  // namespace

Command help_command() {
  return {"help",
          "a command's help, as after --help",
          "  fencepost help\n"
          "  fencepost help import csv\n"
          "  fencepost help replay --roff | man -l -\n",
          [](CLI::App& app) -> Action {
            const auto request = std::make_shared<HelpRequest>();
            app.add_option("COMMAND", request->words, "whose; default: what there is");
            app.add_flag("--roff", request->roff, "as a manual page");
            app.add_option("--pages", request->pages, "instead: all manual pages into a folder")->type_name("DIR");
            return [program = app.get_parent(), request] { return run(*program, *request); };
          },
          {}};
}

}  // namespace fencepost::host::cli
