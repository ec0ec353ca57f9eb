#include "host/recorder/keyboard.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <string_view>

namespace fencepost::host {
namespace {

// Plain memory, because a signal handler may touch nothing else.
termios terminal_before{};
volatile std::sig_atomic_t terminal_taken = 0;

bool something_to_read() {
  pollfd wait{STDIN_FILENO, POLLIN, 0};
  return ::poll(&wait, 1, 0) > 0;
}

}  // namespace

bool in_foreground() { return ::tcgetpgrp(STDIN_FILENO) == ::getpgrp(); }

// Ignored, a read in the background is an error instead of a stop of the whole program.
Keyboard::Keyboard(bool edits) : edits_(edits) {
  std::signal(SIGTTIN, SIG_IGN);
  if (edits_) take_terminal();
}

Keyboard::~Keyboard() {
  terminal_taken = 0;
  if (before_ && in_foreground()) ::tcsetattr(STDIN_FILENO, TCSADRAIN, &*before_);
}

// Ctrl-C, Ctrl-Z and Ctrl-S keep their meaning.
void Keyboard::take_terminal() {
  termios mode{};
  if (!in_foreground() || ::tcgetattr(STDIN_FILENO, &mode) != 0 || (mode.c_lflag & ICANON) == 0) return;
  if (!before_) {
    before_ = terminal_before = mode;
    terminal_taken = 1;
  }
  mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  mode.c_cc[VMIN] = 1;
  mode.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSADRAIN, &mode);
}

void Keyboard::give_back_terminal() {
  if (terminal_taken != 0 && in_foreground()) ::tcsetattr(STDIN_FILENO, TCSANOW, &terminal_before);
}

void Keyboard::tend() {
  if (edits_ && !ended_) take_terminal();
}

int Keyboard::descriptor() const { return ended_ ? -1 : STDIN_FILENO; }

std::string Keyboard::read() {
  std::array<char, 4096> buffer;
  if (ended_ || !something_to_read()) return {};
  const ssize_t count = ::read(STDIN_FILENO, buffer.data(), buffer.size());
  if (count < 0 && (errno == EINTR || errno == EAGAIN)) return {};
  ended_ = count <= 0;
  if (ended_) return {};
  const std::string_view bytes(buffer.data(), static_cast<std::size_t>(count));
  if (!edits_) return std::string(bytes);
  std::string lines;
  for (const char byte : bytes) {
    if (const auto line = line_.push(byte)) lines += *line + '\r';
  }
  return lines;
}

}  // namespace fencepost::host
