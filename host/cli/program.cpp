#include "host/cli/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/cli/describe.hpp"
#include "host/cli/guarded.hpp"
#include "host/cli/help.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/parser.hpp"
#include "host/cli/standard_streams.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host::cli {
namespace {

/// "no command \"repaly\"; did you mean replay?", if a word where a command is due is none.
std::optional<std::string> unknown_command(const std::vector<Command>& table, const std::string& where, int argc,
                                           const char* const* argv) {
  if (argc < 1) return fmt::format("no command given; see {} --help", where);
  const std::string_view word = argv[0];
  const bool of_program = &table == &commands();
  if (of_program && word == "-v") return "no option -v in fencepost; did you mean -V? See fencepost --help";
  if (word == "-h" || word == "--help" || (of_program && (word == "--version" || word == "-V"))) return std::nullopt;
  std::vector<std::string> names = {"--help"};
  if (of_program) names.emplace_back("--version");
  for (const Command& command : table) {
    if (command.name == word) {
      if (command.children.empty()) return std::nullopt;
      return unknown_command(command.children, where + " " + command.name, argc - 1, argv + 1);
    }
    names.push_back(command.name);
  }
  const std::span<const std::string_view> elsewhere = commands_elsewhere();
  if (of_program && std::find(elsewhere.begin(), elsewhere.end(), word) != elsewhere.end()) {
    return fmt::format("{} is not in the program for Windows; use it on Linux, or in WSL", word);
  }
  return fmt::format("no command \"{}\" in {}{}", word, where, guess_among(names, word, where));
}

}  // namespace

int run_program(int argc, const char* const* argv) {
  hold_standard_streams();
  handle_interrupts();
  return guarded([&] {
    if (argc < 2) {
      std::string help = wrapped(overview(), columns_of_stdout());
      help.pop_back();  // the last line end, which say_lines() writes itself
      say_lines(help);
      return static_cast<int>(Exit::kUsage);
    }
    if (const auto unknown = unknown_command(commands(), "fencepost", argc - 1, argv + 1)) {
      throw Failure(Exit::kUsage, *unknown);
    }
    Parser parser;
    return static_cast<int>(parser.parse(argc, argv)());
  });
}

}  // namespace fencepost::host::cli
