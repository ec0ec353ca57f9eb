// Help with the example first.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

#include "host/cli/command.hpp"

namespace fencepost::host::cli {

/// What `fencepost --help` prints.
std::string overview();

/// Prints a command's examples (kept as its footer) before everything else; the program's own help is `overview()`.
class HelpWithExample : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
  std::string make_footer(const CLI::App*) const override { return {}; }
};

}  // namespace fencepost::host::cli
