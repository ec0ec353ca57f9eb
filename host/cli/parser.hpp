// The command line by the table of commands.
#pragma once

#include <memory>

#include "host/cli/command.hpp"

namespace fencepost::host::cli {

class Parser {
 public:
  Parser();
  ~Parser();
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;

  /// The action that the words ask for. It may run while the parser lives. errors: Failure (kUsage)
  Action parse(int argc, const char* const* argv);

 private:
  void add(CLI::App& parent, const Command& command);

  std::unique_ptr<CLI::App> app_;
  Action action_;
};

}  // namespace fencepost::host::cli
