#include "host/cli/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace fencepost::host::cli {
namespace {

using Words = std::vector<std::string>;

std::string joined(const Words& words, std::string_view between = " ") {
  return fmt::format("{}", fmt::join(words, between));
}

Words names_of_commands(const CommandWords& command) {
  Words names;
  for (const CommandWords& child : command.commands) names.push_back(child.name().substr(command.name().size() + 1));
  return names;
}

Words names_of_options(const CommandWords& command) {
  Words names;
  for (const OptionWords& option : command.options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

/// Within single quotes of a shell.
std::string quoted(const std::string& text, std::string_view quote_within) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string(quote_within) : std::string(1, c);
  return out + "'";
}

/// Bash's cases for the values of options; without choices it offers files.
std::string bash_values(const CommandWords& command) {
  std::string cases;
  for (const OptionWords& option : command.options) {
    if (option.value.empty()) continue;
    const std::string words = option.choices.empty() ? "files=1" : "words=" + quoted(joined(option.choices), "'\\''");
    cases += fmt::format("        {}) {} ;;\n", joined(option.names, "|"), words);
  }
  if (cases.empty()) return {};
  return "      case $before in\n" + cases + "      esac\n";
}

std::string bash_command(const CommandWords& command) {
  std::string text = fmt::format("    {})\n      options={}\n", quoted(command.name(), ""),
                                 quoted(joined(names_of_options(command)), ""));
  const Words more = command.commands.empty() ? command.positional_choices : names_of_commands(command);
  if (!more.empty()) text += fmt::format("      plain={}\n", quoted(joined(more), "'\\''"));
  return text + bash_values(command) + "      ;;\n";
}

/// In zsh's [explanations], and before its colons.
std::string zsh_escaped(const std::string& text) {
  std::string out;
  for (const char c : text) out += (c == '[' || c == ']' || c == ':' ? "\\" : "") + std::string(1, c);
  return out;
}

std::string zsh_function(const CommandWords& command) { return "_" + command.name('_'); }

std::string zsh_option(const OptionWords& option) {
  std::string value;
  if (!option.value.empty()) {
    const std::string action = option.choices.empty() ? "_files" : "(" + joined(option.choices) + ")";
    value = ":value:" + action;
  }
  const std::string rest = quoted("[" + zsh_escaped(option.text) + "]" + value, "'\\''");
  const std::string all = option.names.size() > 1 ? "{" + joined(option.names, ",") + "}" : option.names.front();
  return fmt::format("    '*'{}{}", all, rest);
}

std::string zsh_command(const CommandWords& command) {
  std::string text = zsh_function(command) + "() {\n  local state line\n  _arguments -C \\\n";
  for (const OptionWords& option : command.options) text += zsh_option(option) + " \\\n";
  if (command.commands.empty()) {
    const std::string action =
        command.positional_choices.empty() ? "_files" : "(" + joined(command.positional_choices) + ")";
    return text + (command.takes_words ? "    '*:word:" + action + "'\n}\n" : "    && return\n}\n");
  }
  text +=
      "    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command)\n      local -a commands=(\n";
  for (const CommandWords& child : command.commands) {
    text += "        " + quoted(child.path.back() + ":" + zsh_escaped(child.text), "'\\''") + "\n";
  }
  text += "      )\n      _describe command commands ;;\n    argument)\n      case $line[1] in\n";
  for (const CommandWords& child : command.commands) {
    text += fmt::format("        {}) {} ;;\n", child.path.back(), zsh_function(child));
  }
  return text + "      esac ;;\n  esac\n}\n";
}

/// True where the words before the cursor are of this command.
std::string fish_condition(const CommandWords& command) {
  if (command.path.size() == 1) return "__fish_use_subcommand";
  std::string condition;
  for (std::size_t i = 1; i < command.path.size(); ++i) {
    condition += (i > 1 ? "; and " : "") + ("__fish_seen_subcommand_from " + command.path[i]);
  }
  if (command.commands.empty()) return condition;
  return condition + "; and not __fish_seen_subcommand_from " + joined(names_of_commands(command));
}

std::string fish_option(const OptionWords& option) {
  std::string words;
  for (const std::string& name : option.names)
    words += name[1] == '-' ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty()) return words + " -x -a " + quoted(joined(option.choices), "\\'");
  return words + (option.value.empty() ? "" : " -r -F");
}

}  // namespace

std::string bash_completion(const CommandWords& program) {
  std::string paths, commands;
  for (const CommandWords* command : all_commands(program)) {
    if (command->path.size() > 1) paths += (paths.empty() ? "" : "|") + quoted(command->name(), "");
    commands += bash_command(*command);
  }
  return "# bash completion for fencepost: made by `fencepost completion bash`\n"
         "_fencepost() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
         "  local path=fencepost options='' plain='' words='' files='' word\n"
         "  # --option=value comes in three words.\n"
         "  if [[ $current == = ]]; then current=''; elif [[ $before == = ]]; then before=${COMP_WORDS[COMP_CWORD-2]}; "
         "fi\n"
         "  for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
         "    case \"$path $word\" in\n"
         "      " +
         paths +
         ") path=\"$path $word\" ;;\n"
         "    esac\n"
         "  done\n"
         "  case $path in\n" +
         commands +
         "  esac\n"
         "  if [[ -n $words ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
         "  elif [[ -z $files && $current == -* ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  elif [[ -z $files && -n $plain ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$plain\" -- \"$current\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "    compopt -o filenames 2> /dev/null\n"
         "  fi\n"
         "}\n"
         "complete -F _fencepost fencepost\n";
}

std::string zsh_completion(const CommandWords& program) {
  std::string text = "#compdef fencepost\n# made by `fencepost completion zsh`\n";
  for (const CommandWords* command : all_commands(program)) text += zsh_command(*command);
  return text + "if [[ $funcstack[1] == _fencepost ]]; then _fencepost \"$@\"; else compdef _fencepost fencepost; fi\n";
}

std::string fish_completion(const CommandWords& program) {
  std::string text = "# fish completion for fencepost: made by `fencepost completion fish`\n";
  for (const CommandWords* command : all_commands(program)) {
    const std::string when = "complete -c fencepost -n " + quoted(fish_condition(*command), "\\'");
    for (const OptionWords& option : command->options) {
      text += when + fish_option(option) + " -d " + quoted(option.text, "\\'") + "\n";
    }
    for (const CommandWords& child : command->commands) {
      text += when + " -f -a " + child.path.back() + " -d " + quoted(child.text, "\\'") + "\n";
    }
    if (!command->positional_choices.empty()) {
      text += when + " -f -a " + quoted(joined(command->positional_choices), "\\'") + "\n";
    }
  }
  return text;
}

}  // namespace fencepost::host::cli
