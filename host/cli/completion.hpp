// Scripts that complete the program's commands, options and their values in a shell.
#pragma once

#include <string>

#include "host/cli/describe.hpp"

namespace fencepost::host::cli {

std::string bash_completion(const CommandWords& program);
std::string zsh_completion(const CommandWords& program);
std::string fish_completion(const CommandWords& program);

}  // namespace fencepost::host::cli
