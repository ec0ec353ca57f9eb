// The only source that includes CLI11, which takes a compiler as long as ten commands.
#include "host/cli/parser.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <regex>

#include "host/cli/describe.hpp"
#include "host/cli/files.hpp"
#include "host/cli/help.hpp"
#include "host/cli/terminal.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host::cli {
namespace {

/// In the order of a manual page: usage, what it is, options, and last the examples, which are kept as the command's
/// footer. The program's own help is `overview()`.
class HelpInOrder : public CLI::Formatter {
 public:
  HelpInOrder() { label("Positionals", "Arguments"); }
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    if (app->get_parent() == nullptr) return overview();
    return make_usage(app, std::move(name)) + "\n" + make_description(app) + make_positionals(app) +
           make_subcommands(app, mode) + make_groups(app, mode) + "\nExamples:\n" + app->get_footer();
  }
  /// Two blanks at least are between a name and its text: by them it is wrapped.
  std::string make_option(const CLI::Option* option, bool positional) const override {
    const std::string name = "  " + make_option_name(option, positional) + make_option_opts(option);
    const std::size_t column = get_column_width();
    const bool fits = name.size() + 2 <= column;
    const std::string gap(fits ? column - name.size() : column, ' ');
    return name + (fits ? "" : "\n") + gap + make_option_desc(option) + "\n";
  }
};

/// "fencepost import csv"; nothing of no command.
std::string name_of(const CLI::App* app) {
  std::string name;
  for (; app != nullptr; app = app->get_parent()) name = app->get_name() + (name.empty() ? "" : " ") + name;
  return name;
}

/// The words of "TEXT:{micro,small,full}".
std::vector<std::string> choices_of(const std::string& type) {
  const std::size_t begin = type.find('{');
  const std::size_t end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return {};
  return CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',');
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
  words.help = app.get_parent() == nullptr ? overview() : app.help(name_of(app.get_parent()));
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

/// The library's check with words of ours. Its own spell out the largest double, and its name stays in the help.
CLI::Validator reworded(CLI::Validator check, const std::string& words) {
  const auto judge = check;
  check.operation([judge, words](std::string& text) {
    const bool good = judge(text).empty();
    return good ? std::string() : fmt::format("it takes {}, not {}", words, text);
  });
  return check;
}

/// "--seconds: given twice", "b.log: one word too many"; nothing of any other error.
std::optional<std::string> plain_words(const CLI::ParseError& error, const CLI::App& command) {
  const std::string said = error.what();
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr && said.find("At Most 1") != std::string::npos) {
    return said.substr(0, said.find(':')) + ": given twice";
  }
  static const std::regex too_few("(.*): At least (.*) required but received (.*)");
  static const std::regex no_number("Could not convert: (.*) = (.*)");
  std::smatch part;
  if (std::regex_match(said, part, too_few)) {
    return fmt::format("{}: it needs {} values, and {} is there", part.str(1), part.str(2), part.str(3));
  }
  if (std::regex_match(said, part, no_number)) {
    return fmt::format("{}: {} is not a number", part.str(1), part.str(2));
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || command.remaining().empty()) return std::nullopt;
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_name() != "LOG") continue;
    return command.remaining().front() + ": it takes one LOG; report, merge and evaluate take several";
  }
  if (command.get_option_no_throw("--set") != nullptr && command.remaining().front().find('=') != std::string::npos) {
    return command.remaining().front() + ": write --set before a setting";
  }
  return command.remaining().front() + ": nothing here takes this word";
}

/// A shell variable that is not set, mostly.
void refuse_what_is_empty(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_items_expected_min() == 0) continue;  // "--view" alone
    if (std::ranges::find(option->results(), std::string()) == option->results().end()) continue;
    throw Failure(Exit::kUsage, fmt::format("{}: its value is empty; give one, or leave it out; see {} --help",
                                            option->get_name(), name_of(&command)));
  }
}

/// Decides by the name of the option's value in help, such as "T" or "DEG".
bool takes_numbers(const CLI::Option& option) {
  constexpr std::array kNames = {"A B", "D",       "DEG", "DEGREES", "F", "HZ", "M", "MM,MRAD",
                                 "N",   "N,N,...", "PX",  "S",       "T", "X",  "Y"};
  return std::ranges::find(kNames, option.get_type_name()) != kNames.end();
}

/// The command whose options were being read.
const CLI::App& parsed(const CLI::App& program) {
  const CLI::App* app = &program;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  return *app;
}

/// "no option --jsno in fencepost replay; did you mean --json?", if there is one that no command has.
std::optional<std::string> unknown_option(const CLI::App& command) {
  const std::string where = name_of(&command);
  for (const std::string& word : command.remaining()) {
    if (word.size() < 2 || word[0] != '-') continue;
    const std::string flag = word.substr(0, word.find('='));
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    if (flag.size() <= 2) names.clear();  // one letter is near any other
    return fmt::format("no option {} in {}{}", flag, where, guess_among(names, flag, where));
  }
  return std::nullopt;
}

/// "nan" and "inf" are numbers to what converts them; no option means them.
void refuse_what_is_no_number(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (!takes_numbers(*option)) continue;
    for (const std::string& text : option->results()) {
      double value = 0;
      if (!CLI::detail::lexical_cast(text, value) || std::isfinite(value)) continue;
      throw Failure(Exit::kUsage,
                    fmt::format("{}: {} is not a number; see {} --help", option->get_name(), text, name_of(&command)));
    }
  }
}

}  // namespace

Option& Option::takes(const char* value) {
  option_->type_name(value);
  return *this;
}
Option& Option::shown_as(const char* text) {
  option_->option_text(text);
  return *this;
}
Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::one_of(std::vector<std::string> words) {
  const std::string listed = fmt::format("{}", fmt::join(words, ", "));
  option_->check(reworded(CLI::IsMember(std::move(words)), listed));
  return *this;
}
/// With a message that fits on a line: the library's own spells out the largest double.
Option& Option::positive() {
  option_->check(CLI::Validator(
      [](std::string& text) {
        double value = 0;
        const bool good = CLI::detail::lexical_cast(text, value) && value > 0;
        return good ? std::string() : text + " is not a number above 0";
      },
      ""));
  return *this;
}
Option& Option::not_negative() {
  option_->check(reworded(CLI::NonNegativeNumber, "0 or more"));
  return *this;
}
Option& Option::within(int least, int most) {
  option_->check(reworded(CLI::Range(least, most), fmt::format("{} to {}", least, most)));
  return *this;
}
Option& Option::within(double least, double most) {
  option_->check(reworded(CLI::Range(least, most), fmt::format("{:g} to {:g}", least, most)));
  return *this;
}
Option& Option::count(int least, int most) {
  option_->expected(least, most);
  return *this;
}
Option& Option::separated_by(char separator) {
  option_->delimiter(separator);
  return *this;
}
Option& Option::one_word() {
  option_->allow_extra_args(false);
  return *this;
}
Option& Option::repeated() {
  option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)->allow_extra_args(false);
  return *this;
}

template <class T>
Option Options::value(const std::string& names, T& target, const std::string& text) {
  return Option(*command_->add_option(names, target, text));
}
template Option Options::value(const std::string&, int&, const std::string&);
template Option Options::value(const std::string&, double&, const std::string&);
template Option Options::value(const std::string&, std::uint32_t&, const std::string&);
template Option Options::value(const std::string&, std::uint64_t&, const std::string&);
template Option Options::value(const std::string&, std::string&, const std::string&);
template Option Options::value(const std::string&, std::optional<int>&, const std::string&);
template Option Options::value(const std::string&, std::optional<double>&, const std::string&);
template Option Options::value(const std::string&, std::optional<std::uint32_t>&, const std::string&);
template Option Options::value(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option Options::value(const std::string&, std::optional<std::string>&, const std::string&);
template Option Options::value(const std::string&, std::vector<double>&, const std::string&);
template Option Options::value(const std::string&, std::vector<std::uint32_t>&, const std::string&);
template Option Options::value(const std::string&, std::vector<std::string>&, const std::string&);

void Options::log_camera(std::string& target) {
  value("--camera", target, "a file with an FPCAM line, a scene, or its \"camera\": for logs without FPCAM")
      .takes("FILE");
}

void Options::profile(std::string& target, const std::string& text) {
  value("--profile", target, text).one_of({"micro", "small", "full"});
}

void Options::flag(const std::string& names, bool& target, const std::string& text) {
  command_->add_flag(names, target, text);
}

CommandWords Options::program() const {
  const CLI::App* app = command_;
  while (app->get_parent() != nullptr) app = app->get_parent();
  return words_of(*app, {});
}

Parser::Parser() : app_(std::make_unique<CLI::App>("", "fencepost")) {
  app_->formatter(std::make_shared<HelpInOrder>());
  app_->allow_windows_style_options(false);  // "/tmp/run.log" is a file
  app_->set_version_flag("-V,--version", "fencepost " FENCEPOST_VERSION);
  app_->require_subcommand(1);
  for (const Command& command : commands()) add(*app_, command);
}

Parser::~Parser() = default;

void Parser::add(CLI::App& parent, const Command& command) {
  CLI::App* app = parent.add_subcommand(command.name, command.summary + (command.by_lab ? "; by fencepost-lab" : ""));
  app->footer(command.examples);
  if (command.configure) {
    app->callback([this, action = command.configure(Options(*app))] { action_ = action; });
  }
  for (const Command& child : command.children) add(*app, child);
  if (!command.children.empty()) app->require_subcommand(1);
}

Action Parser::parse(int argc, const char* const* argv) {
  const auto show = [](const std::string& text) -> Action {
    return [text] {
      write_output("-", text);
      return Exit::kDone;
    };
  };
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return show(std::string(version.what()) + "\n");
  } catch (const CLI::Success&) {
    const CLI::App& command = parsed(*app_);
    return show(wrapped(command.help(name_of(command.get_parent())), columns_of_stdout()));
  } catch (const CLI::ParseError& error) {
    const CLI::App& command = parsed(*app_);
    if (const auto words = unknown_option(command)) throw Failure(Exit::kUsage, *words);
    const std::string words = plain_words(error, command).value_or(error.what());
    throw Failure(Exit::kUsage, fmt::format("{}; see {} --help", words, name_of(&command)));
  }
  refuse_what_is_empty(parsed(*app_));
  refuse_what_is_no_number(parsed(*app_));
  return action_;
}

}  // namespace fencepost::host::cli
