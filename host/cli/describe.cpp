#include "host/cli/describe.hpp"

#include <fmt/format.h>

#include "host/cli/exit_code.hpp"
#include "host/cli/help.hpp"
#include "host/text/suggest.hpp"

namespace fencepost::host::cli {
namespace {

/// The words of "TEXT:{micro,small,full}" or "ENUM:value in {truth->1,odometry->0} OR {0,1}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  std::vector<std::string> words;
  if (begin == std::string::npos || end == std::string::npos) return words;
  for (const std::string& item : CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',')) {
    words.push_back(item.substr(0, item.find("->")));
  }
  return words;
}

OptionWords words_of(const CLI::Option& option) {
  OptionWords words;
  for (const std::string& name : option.get_snames()) words.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) words.names.push_back("--" + name);
  if (option.get_items_expected_max() > 0) words.value = option.get_type_name();
  words.choices = choices_of(words.value);
  words.text = option.get_description();
  return words;
}

CommandWords words_of(const CLI::App& app, std::vector<std::string> path) {
  CommandWords words;
  path.push_back(app.get_name());
  words.path = std::move(path);
  words.text = app.get_description();
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      words.takes_words = true;
      words.positional_choices = choices_of(option->get_type_name());
    } else {
      words.options.push_back(words_of(*option));
    }
  }
  for (const CLI::App* child : app.get_subcommands({})) words.commands.push_back(words_of(*child, words.path));
  return words;
}

void collect(const CommandWords& command, std::vector<const CommandWords*>& all) {
  all.push_back(&command);
  for (const CommandWords& child : command.commands) collect(child, all);
}

std::string name_of(const CLI::App* app) {
  std::string name;
  for (; app != nullptr; app = app->get_parent()) name = app->get_name() + (name.empty() ? "" : " ") + name;
  return name;
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

CommandWords describe(const CLI::App& program) { return words_of(program, {}); }

std::vector<const CommandWords*> all_commands(const CommandWords& program) {
  std::vector<const CommandWords*> all;
  collect(program, all);
  return all;
}

const CLI::App& find_command(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* app = &program;
  for (const std::string& word : words) {
    std::vector<std::string> names;
    const CLI::App* found = nullptr;
    for (const CLI::App* child : app->get_subcommands({})) {
      names.push_back(child->get_name());
      if (child->get_name() == word) found = child;
    }
    if (found == nullptr) {
      const std::string where = name_of(app);
      throw Failure(Exit::kUsage,
                    fmt::format("no command \"{}\" in {}{}", word, where, guess_among(names, word, where)));
    }
    app = found;
  }
  return *app;
}

std::string help_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  // The program's own would be that of the command which is running.
  return parent == nullptr ? overview() : command.help(name_of(parent));
}

}  // namespace fencepost::host::cli
