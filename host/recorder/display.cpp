#include "host/recorder/display.hpp"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <system_error>
#include <utility>

#include "host/text/printable.hpp"
#include "host/text/wrap.hpp"

namespace fencepost::host {
namespace {

constexpr std::string_view kEraseLine = "\r\x1b[K";
constexpr std::size_t kUsualWidth = 80;

bool can_write(int timeout_ms) {
  pollfd wait{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&wait, 1, timeout_ms) > 0;
}

void write_error(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(STDERR_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Escape sequences in line noise would reconfigure the terminal.
void make_harmless(std::string& line) {
  std::erase(line, '\r');
  const std::string as_it_came = line;
  line = printable(line);
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (as_it_came[i] == '\n' || as_it_came[i] == '\t') line[i] = as_it_came[i];
  }
}

}  // namespace

void Display::take(std::string_view bytes) {
  if (!settings_.lines || closed_) return;
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size() - 1) + 1;
    line_ += bytes.substr(0, end);
    bytes.remove_prefix(end);
    // Noise may have no line ends at all.
    if (line_.back() == '\n' || line_.size() > kMaxWaiting) queue_line();
  }
}

void Display::queue_line() {
  if (settings_.out_is_terminal) make_harmless(line_);
  if (waiting_.size() + line_.size() <= kMaxWaiting) {
    waiting_ += line_;
  } else {
    ++lines_not_shown_;
  }
  line_.clear();
}

int Display::descriptor() const { return waiting_.empty() ? -1 : STDOUT_FILENO; }

void Display::flush() {
  if (waiting_.empty()) return;
  const bool shared = settings_.out_is_terminal && status_drawn_;
  if (shared) erase_status();
  while (!waiting_.empty() && can_write(0)) write_some();
  if (shared) draw_status();
}

// A pipe that can be written takes this much without waiting (pipe(7)).
void Display::write_some() {
  const ssize_t count = ::write(STDOUT_FILENO, waiting_.data(), std::min<std::size_t>(waiting_.size(), PIPE_BUF));
  if (count >= 0) {
    waiting_.erase(0, static_cast<std::size_t>(count));
  } else if (errno != EINTR && errno != EAGAIN) {
    stop_showing(errno);
  }
}

void Display::stop_showing(int error) {
  closed_ = true;
  waiting_.clear();
  line_.clear();
  const std::string reason = error == EPIPE ? "its reader has gone" : std::generic_category().message(error);
  say("standard output is closed (" + reason + "); the recording goes on");
}

void Display::finish(int timeout_ms) {
  set_status({});
  if (!line_.empty()) {
    if (settings_.out_is_terminal) line_ += '\n';
    queue_line();
  }
  while (!waiting_.empty() && can_write(timeout_ms)) write_some();
  lines_not_shown_ += static_cast<std::uint64_t>(std::count(waiting_.begin(), waiting_.end(), '\n'));
  waiting_.clear();
}

void Display::say(std::string_view message) {
  erase_status();
  write_error(printable(message) + "\n");
  draw_status();
}

void Display::set_status(const std::string& status) {
  std::string text = printable(status);
  if (!settings_.status || text == status_) return;
  erase_status();
  status_ = std::move(text);
  draw_status();
}

void Display::erase_status() {
  if (status_drawn_) write_error(kEraseLine);
  status_drawn_ = false;
}

void Display::draw_status() {
  if (status_.empty()) return;
  write_error(status_);
  status_drawn_ = true;
}

// The last column stays free: a character in it makes some terminals wrap.
std::size_t Display::status_width() {
  const std::size_t columns = terminal_size(STDERR_FILENO).ws_col;
  return (columns > 1 ? columns : kUsualWidth) - 1;
}

}  // namespace fencepost::host
