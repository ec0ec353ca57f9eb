#include "host/cli/describe.hpp"

#include <fmt/format.h>

#include "host/cli/exit_code.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host::cli {
namespace {

void collect(const CommandWords& command, std::vector<const CommandWords*>& all) {
  all.push_back(&command);
  for (const CommandWords& child : command.commands) collect(child, all);
}

}  // namespace

std::string CommandWords::name(char between) const {
  std::string name;
  for (const std::string& word : path) name += (name.empty() ? std::string() : std::string(1, between)) + word;
  return name;
}

std::string guess_among(const std::vector<std::string>& names, std::string_view word, const std::string& where) {
  const std::string guess = did_you_mean(word, names);
  return fmt::format(";{} {} {} --help", guess, guess.empty() ? "see" : "See", where);
}

std::vector<const CommandWords*> all_commands(const CommandWords& program) {
  std::vector<const CommandWords*> all;
  collect(program, all);
  return all;
}

const CommandWords& find_command(const CommandWords& program, const std::vector<std::string>& words) {
  const CommandWords* command = &program;
  for (const std::string& word : words) {
    std::vector<std::string> names;
    const CommandWords* found = nullptr;
    for (const CommandWords& child : command->commands) {
      names.push_back(child.path.back());
      if (names.back() == word) found = &child;
    }
    if (found == nullptr) {
      throw Failure(Exit::kUsage, fmt::format("no command \"{}\" in {}{}", word, command->name(),
                                              guess_among(names, word, command->name())));
    }
    command = found;
  }
  return *command;
}

}  // namespace fencepost::host::cli
