// A number greater than zero, with a message that fits on a line (the library's own spells out the largest double).
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace fencepost::host::cli {

inline CLI::Validator positive() {
  return {[](std::string& text) {
            double value = 0;
            const bool good = CLI::detail::lexical_cast(text, value) && value > 0;
            return good ? std::string() : text + " is not a number above 0";
          },
          ""};
}

}  // namespace fencepost::host::cli
