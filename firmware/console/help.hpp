// `help`: every command and every setting, one a line.
#pragma once

#include <cstddef>
#include <span>

#include "firmware/config/settings.hpp"
#include "firmware/console/command.hpp"
#include "firmware/console/sentence.hpp"

namespace fencepost::console {

inline constexpr std::size_t kHelpLines = 1 + kVerbs + 2 + config::kKeys;

/// `line` < kHelpLines.
std::size_t write_help(std::size_t line, const config::Settings& settings, std::span<char> out);

/// One setting, its value, range, unit and meaning.
std::size_t write_setting(config::Key key, const config::Settings& settings, std::span<char> out);

/// "0.00..10.00 m" or "on|off".
void put_range(Sentence& sentence, config::Key key);

}  // namespace fencepost::console
