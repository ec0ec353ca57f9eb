#include "host/cli/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "host/cli/command.hpp"
#include "host/cli/describe.hpp"
#include "host/cli/files.hpp"
#include "host/cli/guarded.hpp"
#include "host/cli/help.hpp"
#include "host/cli/interrupt.hpp"
#include "host/cli/standard_streams.hpp"

namespace fencepost::host::cli {
namespace {

/// "no command \"repaly\"; did you mean replay?", if a word where a command is due is none.
std::optional<std::string> unknown_command(const std::vector<Command>& table, const std::string& where, int argc,
                                           const char* const* argv) {
  if (argc < 1) return fmt::format("no command given; see {} --help", where);
  const std::string_view word = argv[0];
  const bool of_program = &table == &commands();
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
  return fmt::format("no command \"{}\" in {}{}", word, where, guess_among(names, word, where));
}

/// By what help calls its value, such as "T" or "DEG".
bool takes_numbers(const CLI::Option& option) {
  constexpr std::array kNames = {"A B", "D",       "DEG", "DEGREES", "F", "HZ", "M", "MM,MRAD",
                                 "N",   "N,N,...", "PX",  "S",       "T", "X",  "Y"};
  return std::ranges::find(kNames, option.get_type_name()) != kNames.end();
}

class Program {
 public:
  Program() : app_("", "fencepost") {
    app_.formatter(std::make_shared<HelpWithExample>());
    app_.set_version_flag("-V,--version", "fencepost " FENCEPOST_VERSION);
    app_.require_subcommand(1);
    for (const Command& command : commands()) add(app_, command);
  }

  int run(int argc, const char* const* argv) {
    if (const auto unknown = unknown_command(commands(), "fencepost", argc - 1, argv + 1)) {
      throw Failure(Exit::kUsage, *unknown);
    }
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& success) {
      write_output("-", help_text(success));
      return static_cast<int>(Exit::kDone);
    } catch (const CLI::ParseError& error) {
      throw Failure(Exit::kUsage,
                    unknown_option().value_or(fmt::format("{}; see {} --help", error.what(), parsed_name())));
    }
    refuse_what_is_no_number();
    return static_cast<int>(action_());
  }

 private:
  void add(CLI::App& parent, const Command& command) {
    CLI::App* app = parent.add_subcommand(command.name, command.summary);
    app->footer(command.examples);
    if (command.configure) {
      app->callback([this, action = command.configure(*app)] { action_ = action; });
    }
    for (const Command& child : command.children) add(*app, child);
    if (!command.children.empty()) app->require_subcommand(1);
  }

  /// "no option --jsno in fencepost replay; did you mean --json?", if there is one that no command has.
  [[nodiscard]] std::optional<std::string> unknown_option() const {
    for (const std::string& word : parsed().remaining()) {
      if (word.size() < 2 || word[0] != '-') continue;
      const std::string flag = word.substr(0, word.find('='));
      std::vector<std::string> names;
      for (const CLI::Option* option : parsed().get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
      }
      if (flag.size() <= 2) names.clear();  // one letter is near any other
      return fmt::format("no option {} in {}{}", flag, parsed_name(), guess_among(names, flag, parsed_name()));
    }
    return std::nullopt;
  }

  /// "nan" and "inf" are numbers to what converts them; no option means them.
  void refuse_what_is_no_number() const {
    for (const CLI::Option* option : parsed().get_options()) {
      if (!takes_numbers(*option)) continue;
      for (const std::string& text : option->results()) {
        double value = 0;
        if (!CLI::detail::lexical_cast(text, value) || std::isfinite(value)) continue;
        throw Failure(Exit::kUsage,
                      fmt::format("{}: {} is not a number; see {} --help", option->get_name(), text, parsed_name()));
      }
    }
  }

  /// The command whose options were being read.
  [[nodiscard]] const CLI::App& parsed() const {
    const CLI::App* app = &app_;
    while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
    return *app;
  }
  [[nodiscard]] std::string parsed_name() const {
    std::string name;
    for (const CLI::App* app = &parsed(); app != nullptr; app = app->get_parent()) {
      name = app->get_name() + (name.empty() ? "" : " ") + name;
    }
    return name;
  }
  [[nodiscard]] std::string help_text(const CLI::Success& success) const {
    if (dynamic_cast<const CLI::CallForVersion*>(&success) != nullptr) return std::string(success.what()) + "\n";
    const std::string name = parsed_name();
    return parsed().help(name.substr(0, name.rfind(' ')));
  }

  CLI::App app_;
  Action action_;
};

}  // namespace

int run_program(int argc, const char* const* argv) {
  hold_standard_streams();
  handle_interrupts();
  return guarded([&] { return Program().run(argc, argv); });
}

}  // namespace fencepost::host::cli
