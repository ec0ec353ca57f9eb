#include "host/live/console_port.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdlib>

#include "host/live/listening_console.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::host {
namespace {

using base::Error;
using linux::Descriptor;

/// Bytes that a terminal takes without waiting once poll(2) says that it can be written.
constexpr std::size_t kTerminalPortion = 256;
constexpr std::size_t kPipePortion = 4096;  // for a pipe: PIPE_BUF

/// A file is abandoned after its disk took nothing for this long while the memory for it is full.
constexpr base::Duration kGivenUp = base::milliseconds(10'000);

constexpr std::string_view kAllowed =
    "allowed: - (this terminal), pty, tcp:HOST:PORT, tcp-listen:[HOST:]PORT, /dev/tty...[,baud=N]";

std::size_t length_of(ssize_t count) { return static_cast<std::size_t>(count); }

bool writable(int fd) {
  pollfd wait{fd, POLLOUT, 0};
  return ::poll(&wait, 1, 0) > 0;
}

bool is_file(int fd) {
  struct stat about {};
  return ::fstat(fd, &about) == 0 && S_ISREG(about.st_mode);
}

linux::Problem output_failure(int error) {
  if (error == EPIPE) return {"nobody reads standard output any more"};
  return linux::failure("write", "standard output", error,
                        "free some space, or write elsewhere; --log FILE keeps a log");
}

std::optional<std::uint32_t> baud_in(std::string_view option) {
  constexpr std::string_view kStart = "baud=";
  if (!option.starts_with(kStart)) return std::nullopt;
  option.remove_prefix(kStart.size());
  std::uint32_t baud = 0;
  const char* end = option.data() + option.size();
  const bool whole = std::from_chars(option.data(), end, baud).ptr == end;
  return whole && baud >= 50 && baud <= 4'000'000 ? std::optional(baud) : std::nullopt;
}

constexpr std::string_view kListen = "tcp-listen:";

/// "no such place", or the fault in the port of a TCP place.
std::string_view fault_of(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::string_view port = colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  const bool number = !port.empty() && port.find_first_not_of("0123456789") == std::string_view::npos;
  if (!text.starts_with("tcp") || !number) return "no such place";
  return text.starts_with(kListen) ? "a port is 0, which takes any free one, to 65535" : "a port is 1 to 65535";
}

/// "4000" or "HOST:4000"; of 0 the system chooses one. Whoever reaches a console can silence its alerts: without HOST
/// only this machine does.
std::optional<Place> listened_at(std::string_view text) {
  const bool host = text.find(':') != std::string_view::npos;
  return parse_tcp((host ? "tcp:" : "tcp:127.0.0.1:") + std::string(text), 0);
}

}  // namespace

base::Result<ConsoleSpec, std::string> parse_console(std::string_view text) {
  ConsoleSpec spec;
  if (text == "-") return spec;
  if (text == "pty") {
    spec.kind = ConsoleSpec::Kind::kPty;
    return spec;
  }
  if (text.starts_with(kListen)) {
    const auto place = listened_at(text.substr(kListen.size()));
    if (!place) return fmt::format("console \"{}\": {}; {}", text, fault_of(text), kAllowed);
    spec.kind = ConsoleSpec::Kind::kListen;
    spec.place = *place;
    return spec;
  }
  spec.kind = ConsoleSpec::Kind::kLine;
  if (const auto tcp = parse_tcp(text)) {
    spec.place = *tcp;
    return spec;
  }
  const std::size_t comma = text.find(',');
  const std::string_view path = text.substr(0, comma);
  if (path.find('/') == std::string_view::npos) {
    return fmt::format("console \"{}\": {}; {}", text, fault_of(text), kAllowed);
  }
  spec.place = {PlaceKind::kTty, std::string(path), 0};
  if (comma == std::string_view::npos) return spec;
  const std::string_view option = text.substr(comma + 1);
  const auto baud = baud_in(option);
  if (!baud) return fmt::format("console \"{}\": \"{}\" is no baud=N; {}", text, option, kAllowed);
  spec.baud = *baud;
  return spec;
}

// --- this terminal ---

/// A file that the shell has opened: `> run.log`.
class OpenFile final : public Sink {
 public:
  explicit OpenFile(int fd) : fd_(fd) {}
  Fault write(std::string_view lines, base::Time /*now*/) override {
    while (!lines.empty()) {
      const ssize_t count = ::write(fd_, lines.data(), lines.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return output_failure(errno);
      bytes_ += static_cast<std::uint64_t>(count);
      lines.remove_prefix(length_of(count));
    }
    return std::nullopt;
  }
  Fault tend(base::Time /*now*/) override { return std::nullopt; }
  Fault close() override { return std::nullopt; }
  [[nodiscard]] std::string name() const override { return "standard output"; }
  [[nodiscard]] std::uint64_t bytes() const override { return bytes_; }

 private:
  int fd_;
  std::uint64_t bytes_ = 0;
};

TerminalConsole::TerminalConsole(int input, int output)
    : input_(input),
      output_(output),
      input_is_terminal_(::isatty(input) == 1),
      output_is_terminal_(::isatty(output) == 1) {
  if (is_file(output)) file_.emplace(std::make_unique<OpenFile>(output));
}

// The kernel stops a background process that reads its terminal.
bool TerminalConsole::may_read() const {
  return !ended_ && (!input_is_terminal_ || ::tcgetpgrp(input_) == ::getpgrp());
}

int TerminalConsole::descriptor() const { return may_read() ? input_ : -1; }

base::Result<std::size_t> TerminalConsole::read(std::span<std::uint8_t> in) {
  if (!may_read() || in.empty()) return Error::kNotReady;
  pollfd wait{input_, POLLIN, 0};
  if (::poll(&wait, 1, 0) <= 0) return Error::kNotReady;
  const ssize_t count = ::read(input_, in.data(), in.size());
  if (count > 0) return length_of(count);
  ended_ = count == 0 || (errno != EAGAIN && errno != EINTR);
  return Error::kNotReady;
}

base::Result<std::size_t> TerminalConsole::write(std::span<const std::uint8_t> out) {
  if (out.empty()) return std::size_t{0};
  if (lost()) return Error::kGone;
  const std::string_view bytes{static_cast<const char*>(static_cast<const void*>(out.data())), out.size()};
  if (file_) return write_file(bytes);
  if (!writable(output_)) return Error::kFull;
  const ssize_t count = output_is_terminal_ ? write_terminal(bytes) : write_some(bytes.substr(0, kPipePortion));
  if (count >= 0) return length_of(count);
  if (errno == EAGAIN || errno == EINTR) return Error::kFull;
  error_ = errno;
  return Error::kGone;
}

base::Result<std::size_t> TerminalConsole::write_file(std::string_view bytes) {
  const std::size_t taken = file_->put(bytes, now_);
  if (taken > 0) return taken;
  if (file_->stalled(now_) >= kGivenUp) error_ = EIO;
  return Error::kFull;
}

ssize_t TerminalConsole::write_some(std::string_view bytes) { return ::write(output_, bytes.data(), bytes.size()); }

// Names come from cameras, robot files and people; their control characters are not passed on.
ssize_t TerminalConsole::write_terminal(std::string_view bytes) {
  bytes = bytes.substr(0, kTerminalPortion);
  const auto shown_as = [](PrintableBytes& shown, char c) {
    const char as = shown.next(c);
    return c == '\n' || c == '\r' || c == '\t' ? c : as;
  };
  std::string harmless(bytes);
  PrintableBytes ahead = shown_;
  for (char& c : harmless) c = shown_as(ahead, c);
  const ssize_t count = write_some(harmless);
  for (ssize_t i = 0; i < count; ++i) shown_as(shown_, bytes[length_of(i)]);
  return count;
}

std::optional<std::string> TerminalConsole::lost() const {
  if (error_ != 0) return output_failure(error_).sentence;
  const auto fault = file_ ? file_->fault() : std::nullopt;
  return fault ? std::optional(fault->sentence) : std::nullopt;
}

std::uint64_t TerminalConsole::finish(std::chrono::milliseconds patience) {
  if (!file_) return 0;
  const bool all = file_->close(patience);
  return file_->lost() + (all ? 0 : file_->waiting());
}

void TerminalConsole::watch(linux::WaitSet& set, bool output_waits) const {
  set.add_readable(descriptor());
  if (output_waits && error_ == 0 && !file_) set.add_writable(output_);  // poll(2) reports files as always writable
}

// --- a pseudo-terminal ---

std::unique_ptr<PtyConsole> PtyConsole::open() {
  const auto fail = [] {
    return DeviceFailure{
        false,
        linux::failure("make a pseudo-terminal", "for the console", errno, "see whether /dev/pts is mounted").sentence};
  };
  Descriptor master(::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  std::array<char, 64> name{};
  const bool made = master.open() && ::grantpt(master.get()) == 0 && ::unlockpt(master.get()) == 0 &&
                    ::ptsname_r(master.get(), name.data(), name.size()) == 0;
  if (!made) throw fail();
  Descriptor slave(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  termios line{};
  if (!slave.open() || ::tcgetattr(slave.get(), &line) != 0) throw fail();
  ::cfmakeraw(&line);  // no echo: output would come back as commands
  if (::tcsetattr(slave.get(), TCSANOW, &line) != 0) throw fail();
  return std::unique_ptr<PtyConsole>(new PtyConsole(std::move(master), std::move(slave), name.data()));
}

base::Result<std::size_t> PtyConsole::read(std::span<std::uint8_t> in) {
  const ssize_t count = in.empty() ? 0 : ::read(master_.get(), in.data(), in.size());
  if (count > 0) return length_of(count);
  return Error::kNotReady;
}

base::Result<std::size_t> PtyConsole::write(std::span<const std::uint8_t> out) {
  const ssize_t count = ::write(master_.get(), out.data(), out.size());
  if (count > 0) return length_of(count);
  return Error::kFull;
}

// --- any of them ---

std::unique_ptr<ConsolePort> open_console(const ConsoleSpec& spec, bool wait) {
  switch (spec.kind) {
    case ConsoleSpec::Kind::kTerminal: return std::make_unique<TerminalConsole>(STDIN_FILENO, STDOUT_FILENO);
    case ConsoleSpec::Kind::kPty: return PtyConsole::open();
    case ConsoleSpec::Kind::kListen: return ListeningConsole::open(spec.place.name, spec.place.port);
    case ConsoleSpec::Kind::kLine: break;
  }
  return std::make_unique<LineConsole>(open_line(spec.place, spec.baud, {"console", wait}));
}

}  // namespace fencepost::host
