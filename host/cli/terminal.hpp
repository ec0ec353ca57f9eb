// Messages for people, and whether the terminal shows colours.
#pragma once

#include <cstddef>
#include <string_view>

namespace fencepost::host::cli {

bool is_terminal(int descriptor);

/// Standard output is a terminal, NO_COLOR is not set and TERM is not "dumb".
bool colour_on_stdout();

/// How wide standard output is: a terminal's columns, else COLUMNS of the environment, else 80. At least 40.
std::size_t columns_of_stdout();

/// TERM is not "dumb": a line can be erased and rewritten.
bool can_redraw();

/// Where standard error is a terminal: a line end, because it has shown ^C just now.
void leave_interrupted_line();

/// One message line to standard error. What it quotes of a file or a robot cannot move the cursor or begin another
/// line.
void say(std::string_view message);
/// The same for several lines of our own words.
void say_lines(std::string_view message);

}  // namespace fencepost::host::cli
