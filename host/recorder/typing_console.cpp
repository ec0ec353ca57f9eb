#include "host/recorder/typing_console.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <utility>

#include "host/recorder/display.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kEraseTyped = "\r\x1b[K";
constexpr std::size_t kPortion = 256;                            // bytes that a terminal takes without waiting
constexpr base::Duration kBellPause = base::milliseconds(2000);  // one alert is repeated faster than that

bool writable() {
  pollfd wait{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&wait, 1, 0) > 0;
}

/// Colour of a sentence that begins with an urgent level.
std::string_view colour_of(std::string_view line) {
  if (line.starts_with("STOP ")) return "\x1b[1;31m";
  if (line.starts_with("BLIND ")) return "\x1b[1;35m";
  if (line.starts_with("WARN ")) return "\x1b[33m";
  return {};
}

/// The end of a line that is wider than the terminal, where the typing goes on.
std::string_view fitting(std::string_view line) {
  const std::size_t width = Display::status_width();
  return line.size() <= width ? line : line.substr(line.size() - width);
}

}  // namespace

int TypingConsole::descriptor() const { return in_foreground() ? keyboard_.descriptor() : -1; }

base::Result<std::size_t> TypingConsole::read(std::span<std::uint8_t> in) {
  if (in_foreground()) {
    std::string lines = keyboard_.read();
    for (std::size_t end = lines.find('\r'); end != std::string::npos; end = lines.find('\r')) {
      take_line(std::string_view(lines).substr(0, end));
      lines.erase(0, end + 1);
    }
    refresh({});
  }
  const std::size_t count = std::min(in.size(), commands_.size());
  if (count == 0) return base::Error::kNotReady;
  std::copy_n(commands_.begin(), count, in.begin());
  commands_.erase(0, count);
  return count;
}

/// It stays on the screen, with its answer below.
void TypingConsole::take_line(std::string_view typed) {
  refresh(std::string(typed) + "\n");
  if (typed == "quit" || typed == "exit") {
    std::raise(SIGTERM);
    return;
  }
  commands_ += typed;
  commands_ += '\r';
}

base::Result<std::size_t> TypingConsole::write(std::span<const std::uint8_t> out) {
  if (error_ != 0) return base::Error::kGone;
  flush();
  if (waiting_.size() > kMaxWaiting) return base::Error::kFull;
  std::string lines;
  for (const std::uint8_t byte : out) {
    if (byte != '\n') {
      line_ += static_cast<char>(byte);
      continue;
    }
    lines += shown(std::exchange(line_, {}));
  }
  if (!lines.empty()) refresh(lines);
  return out.size();
}

// Names come from cameras, robot files and people; their control characters are not passed on.
std::string TypingConsole::shown(std::string line) {
  if (line.ends_with('\r')) line.pop_back();
  line = printable(line);
  const std::string_view colour = colour_of(line);
  const bool urgent = line.starts_with("STOP ") || line.starts_with("BLIND ");
  const bool rings = urgent && (!urgent_at_ || now_ - *urgent_at_ >= kBellPause);
  if (urgent) urgent_at_ = now_;
  if (colour_ && !colour.empty()) line = std::string(colour) + line + "\x1b[0m";
  return line + (rings ? "\a\n" : "\n");
}

void TypingConsole::refresh(std::string_view lines) {
  const std::string typing(fitting(keyboard_.typing()));
  if (lines.empty() && typing == drawn_) return;
  if (!drawn_.empty()) waiting_ += kEraseTyped;
  waiting_ += lines;
  waiting_ += typing;
  drawn_ = typing;
  flush();
}

void TypingConsole::flush() {
  while (!waiting_.empty() && error_ == 0 && writable()) {
    const ssize_t count = ::write(STDOUT_FILENO, waiting_.data(), std::min(kPortion, waiting_.size()));
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (count < 0) error_ = errno;
    if (count > 0) waiting_.erase(0, static_cast<std::size_t>(count));
  }
}

void TypingConsole::tend(base::Time now) {
  now_ = now;
  keyboard_.tend();
  flush();
}

std::optional<std::string> TypingConsole::lost() const {
  if (error_ == 0) return std::nullopt;
  return "the terminal has gone (" + std::generic_category().message(error_) + ")";
}

std::uint64_t TypingConsole::finish(std::chrono::milliseconds patience) {
  if (!drawn_.empty()) waiting_ += kEraseTyped;
  drawn_.clear();
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!waiting_.empty() && error_ == 0 && std::chrono::steady_clock::now() < end) {
    pollfd wait{STDOUT_FILENO, POLLOUT, 0};
    ::poll(&wait, 1, 50);
    flush();
  }
  return waiting_.size();
}

void TypingConsole::watch(linux::WaitSet& set, bool output_waits) const {
  set.add_readable(descriptor());
  if ((output_waits || !waiting_.empty()) && error_ == 0) set.add_writable(STDOUT_FILENO);
}

void TypingConsole::without_typed_line(const std::function<void()>& write) {
  if (!drawn_.empty()) waiting_ += kEraseTyped;
  drawn_.clear();
  flush();
  write();
  refresh({});
}

}  // namespace fencepost::host
