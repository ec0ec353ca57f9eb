#include "host/monitor/terminal_screen.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <string_view>

#include "host/text/wrap.hpp"

namespace fencepost::host::monitor {
namespace {

constexpr std::string_view kTake = "\x1b[?1049h\x1b[?25l\x1b[2J";
constexpr std::string_view kGiveBack = "\x1b[0m\x1b[?25h\x1b[?1049l";
/// Wider than any screen; some terminals say 65535 columns and rows, whose cells would take 170 GB.
constexpr unsigned short kMaxColumns = 1'000;
constexpr unsigned short kMaxRows = 500;  ///< likewise
constexpr std::array kFaults = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};

// Plain memory, because a signal handler may touch nothing else.
termios terminal_before{};
volatile std::sig_atomic_t keys_taken = 0;
volatile std::sig_atomic_t screen_taken = 0;

bool write_all(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

extern "C" void on_fault(int number) {
  TerminalScreen::give_back();
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

TerminalScreen::TerminalScreen(bool colour) : colour_(colour), has_keys_(::isatty(STDIN_FILENO) == 1) {
  for (const int fault : kFaults) std::signal(fault, on_fault);
  termios mode{};
  if (has_keys_ && ::tcgetattr(STDIN_FILENO, &mode) == 0) {
    terminal_before = mode;
    keys_taken = 1;
    mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    mode.c_cc[VMIN] = 0;
    mode.c_cc[VTIME] = 0;
    mode.c_cc[VSUSP] = _POSIX_VDISABLE;  // a stopped program would leave its screen behind
    ::tcsetattr(STDIN_FILENO, TCSADRAIN, &mode);
  }
  screen_taken = 1;
  write_all(kTake);
}

TerminalScreen::~TerminalScreen() {
  give_back();
  for (const int fault : kFaults) std::signal(fault, SIG_DFL);
}

void TerminalScreen::give_back() {
  if (screen_taken != 0) write_all(kGiveBack);
  screen_taken = 0;
  if (keys_taken != 0) ::tcsetattr(STDIN_FILENO, TCSANOW, &terminal_before);
  keys_taken = 0;
}

Size TerminalScreen::size() {
  const winsize window = terminal_size(STDOUT_FILENO);
  if (window.ws_col == 0 || window.ws_row == 0) return {};
  return {std::min(window.ws_col, kMaxColumns), std::min(window.ws_row, kMaxRows)};
}

bool TerminalScreen::show(const Cells& cells, bool bell) {
  std::string bytes;
  if (cells.size() != shown_size_) {
    bytes += "\x1b[0m\x1b[2J";
    shown_size_ = cells.size();
    shown_.assign(shown_size_.rows, std::string());
  }
  for (std::size_t row = 0; row < shown_size_.rows; ++row) {
    std::string text = cells.row(row, colour_);
    if (text == shown_[row]) continue;
    bytes += "\x1b[" + std::to_string(row + 1) + ";1H" + text + "\x1b[K";
    shown_[row] = std::move(text);
  }
  if (bell) bytes += '\a';
  return write_all(bytes);
}

std::string TerminalScreen::keys() {
  std::string typed;
  std::array<char, 256> buffer{};
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  while (has_keys_ && ::poll(&wait, 1, 0) > 0) {
    const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (count <= 0) {
      has_keys_ = count < 0 && errno == EINTR;
      break;
    }
    for (ssize_t i = 0; i < count; ++i) {
      const char c = buffer[static_cast<std::size_t>(i)];
      if (c == '\x1b') break;  // a cursor key's sequence comes as one
      typed += c;
    }
  }
  return typed;
}

}  // namespace fencepost::host::monitor
