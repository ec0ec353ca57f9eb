// The options of one command, as its file declares them. No library is included for it: parser.cpp has the only one.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fencepost::host::cli {

struct CommandWords;

/// One option that was declared, to say more about it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  /// How help calls its value, such as "FILE". "N", "S" and others like them are numbers: nan and inf are refused.
  Option& takes(const char* value);
  /// Replaces in help the text behind the option's name.
  Option& shown_as(const char* text);
  Option& required();

  Option& one_of(std::vector<std::string> words);
  Option& positive();
  Option& not_negative();
  Option& within(int least, int most);
  Option& within(double least, double most);

  /// Of a list: the number of words that follow the option; -1 as `most` is any number.
  Option& count(int least, int most);
  Option& count(int number) { return count(number, number); }
  /// Of a list: one argument may also hold several words, separated so.
  Option& separated_by(char separator);
  /// Of a list: one word follows each mention of the option, which help shows as that of a list or as a single one.
  Option& one_word();
  Option& repeated();

 private:
  CLI::Option* option_;
};

/// A command's options, added to its parser. A handle: a copy is the same command, as long as the program runs.
class Options {
 public:
  explicit Options(CLI::App& command) : command_(&command) {}

  /// `names`: "-o,--output". `target` holds what counts without the option: text, a number, an optional or list of
  /// them; parser.cpp has the types.
  template <class T>
  Option value(const std::string& names, T& target, const std::string& text);
  /// A word, or a list of words, in its place on the line.
  template <class T>
  Option positional(const std::string& name, T& target, const std::string& text) {
    return value(name, target, text);
  }
  /// --camera, of a log that does not have its own.
  void log_camera(std::string& target);
  /// --profile: micro, small or full.
  void profile(std::string& target, const std::string& text = "capacities of the robot; default: the log's, else full");
  void flag(const std::string& names, bool& target, const std::string& text);

  /// Every command, with its help.
  [[nodiscard]] CommandWords program() const;

 private:
  CLI::App* command_;
};

}  // namespace fencepost::host::cli
