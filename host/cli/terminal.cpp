#include "host/cli/terminal.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>

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

void leave_interrupted_line() {
  if (is_terminal(STDERR_FILENO)) std::fputc('\n', stderr);
}

void say(std::string_view message) {
  std::fwrite(message.data(), 1, message.size(), stderr);
  std::fputc('\n', stderr);
}

}  // namespace fencepost::host::cli
