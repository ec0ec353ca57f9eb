#include "host/cli/terminal.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "host/cli/progress.hpp"
#include "host/text/printable.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host::cli {

bool is_terminal(int descriptor) { return ::isatty(descriptor) == 1; }

bool can_redraw() {
  const char* term = std::getenv("TERM");
  return term != nullptr && std::string_view(term) != "dumb";
}

bool colour_on_stdout() {
  const char* no_color = std::getenv("NO_COLOR");
  const bool refused = no_color != nullptr && *no_color != '\0';
  return is_terminal(STDOUT_FILENO) && !refused && can_redraw();
}

std::size_t columns_of_stdout() {
  constexpr long kMinColumns = 40;
  constexpr long kMaxColumns = 10'000;
  constexpr long kColumns = 80;
  const long shown = long{terminal_size(STDOUT_FILENO).ws_col};
  const char* given = std::getenv("COLUMNS");
  const long wanted = given == nullptr ? 0 : std::strtol(given, nullptr, 10);
  const long columns = shown > 0 ? shown : wanted > 0 ? wanted : kColumns;
  return static_cast<std::size_t>(std::clamp(columns, kMinColumns, kMaxColumns));
}

void leave_interrupted_line() {
  if (is_terminal(STDERR_FILENO)) std::fputc('\n', stderr);
}

void say(std::string_view message) {
  hide_progress();
  const std::string line = printable(message) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void say_lines(std::string_view message) {
  while (true) {
    const std::size_t end = message.find('\n');
    say(message.substr(0, end));
    if (end == std::string_view::npos) return;
    message.remove_prefix(end + 1);
  }
}

}  // namespace fencepost::host::cli
