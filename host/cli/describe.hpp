// The parser's commands and options, as manual pages and completion need them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host::cli {

struct OptionWords {
  std::vector<std::string> names;    ///< "-o", "--output"
  std::string value;                 ///< "FILE"; empty: a flag
  std::vector<std::string> choices;  ///< of its value; empty: anything, perhaps a file
  std::string text;
};

struct CommandWords {
  std::vector<std::string> path;  ///< "fencepost", "import", "csv"
  std::string text;
  std::string help;  ///< the text of --help
  std::vector<OptionWords> options;
  std::vector<std::string> positional_choices;
  bool takes_words = false;  ///< beside options
  std::vector<CommandWords> commands;

  /// "fencepost import csv"
  [[nodiscard]] std::string name(char between = ' ') const;
};

/// All commands of the tree, each before its own commands.
std::vector<const CommandWords*> all_commands(const CommandWords& program);

/// "; did you mean replay? See fencepost --help", or "; see fencepost --help": the end of a complaint.
std::string guess_among(const std::vector<std::string>& names, std::string_view word, const std::string& where);

/// The command that `words` name below `program`. errors: Failure (kUsage), with a guess
const CommandWords& find_command(const CommandWords& program, const std::vector<std::string>& words);

}  // namespace fencepost::host::cli
