#include "host/live/stop_line.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <utility>

namespace fencepost::host {
namespace {

using Clock = std::chrono::steady_clock;

constexpr char kGo = 'g';
constexpr char kStop = 's';
constexpr std::chrono::milliseconds kPatience{StopLine::kPatience.raw * 1'000 / base::Duration::kPerUnit};

/// The process that has the line. It ends when the other end of `socket` is closed, and leaves the motors held.
class Guard {
 public:
  Guard(int socket, linux::OutputLine& line, bool active_high)
      : socket_(socket), line_(line), active_high_(active_high) {}

  [[noreturn]] void work() {
    drive(false);
    while (true) {
      const auto told = hear();
      if (told && *told == '\0') break;
      if (told) until_ = Clock::now() + kPatience;
      const bool go = told ? *told == kGo : going_ && Clock::now() < until_;
      if (go != going_ || told == kStop) drive(go);
    }
    drive(false);
    ::_exit(0);
  }

 private:
  /// The last that was said; 0: nobody will say anything any more; nothing: nothing was said in time.
  std::optional<char> hear() {
    pollfd watched{socket_, POLLIN, 0};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until_ - Clock::now());
    const int ready = ::poll(&watched, 1, going_ ? std::max(static_cast<int>(left.count()), 0) : -1);
    if (ready <= 0) return std::nullopt;
    std::array<char, 64> said{};
    const ssize_t size = ::read(socket_, said.data(), said.size());
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) return std::nullopt;
    return size > 0 ? said[static_cast<std::size_t>(size) - 1] : '\0';
  }

  void drive(bool go) {
    going_ = go;
    const char error = static_cast<char>(line_.set(go != active_high_));
    if (error != 0) static_cast<void>(::send(socket_, &error, 1, MSG_NOSIGNAL | MSG_DONTWAIT) != 1);
  }

  int socket_;
  linux::OutputLine& line_;
  bool active_high_;
  bool going_ = false;
  Clock::time_point until_;
};

// Ignores the signals that a terminal or a service manager sends to all: they are for the program. The socket shows the
// program's end.
void outlive_the_program() {
  for (const int number : {SIGINT, SIGQUIT, SIGTERM, SIGHUP, SIGTSTP}) std::signal(number, SIG_IGN);
  ::prctl(PR_SET_NAME, "fencepost-stop");
  const int nothing = ::open("/dev/null", O_RDWR);
  if (nothing < 0) return;
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nothing, stream);
  if (nothing > STDERR_FILENO) ::close(nothing);
}

}  // namespace

base::Result<StopLineSpec, std::string> parse_stop_line(std::string_view text) {
  constexpr std::string_view kActiveHigh = ",active-high";
  StopLineSpec spec;
  const std::string whole(text);
  spec.active_high = text.ends_with(kActiveHigh);
  if (spec.active_high) text.remove_suffix(kActiveHigh.size());
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == text.size() ||
      text.find(',') != std::string_view::npos) {
    return "--stop-gpio " + whole + ": write CHIP:LINE[,active-high], such as gpiochip0:17; 'gpioinfo' lists them";
  }
  spec.chip = std::string(text.substr(0, colon));
  spec.line = std::string(text.substr(colon + 1));
  return spec;
}

linux::Opened<std::unique_ptr<StopLine>> StopLine::hold(std::unique_ptr<linux::OutputLine> line, bool active_high,
                                                        std::string name) {
  std::array<int, 2> ends = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return linux::failure("watch over", name, errno, "close some programs");
  linux::Descriptor ours(ends[0]);
  const linux::Descriptor theirs(ends[1]);
  const pid_t process = ::fork();
  if (process < 0) return linux::failure("start a process for", name, errno, "close some programs");
  if (process == 0) {
    ours.close();
    outlive_the_program();
    Guard(theirs.get(), *line, active_high).work();
  }
  ::fcntl(ours.get(), F_SETFL, O_NONBLOCK);
  return std::unique_ptr<StopLine>(new StopLine(std::move(ours), process, std::move(name)));
}

StopLine::~StopLine() { end({}); }

void StopLine::show(const AlertNow& alert, base::Time now) {
  if (sent_ == alert.may_move && now - sent_at_ < kShowInterval) return;
  sent_at_ = now;
  send(alert.may_move);
}

void StopLine::send(bool may_move) {
  sent_ = may_move;
  if (!socket_.open()) return;
  const char what = may_move ? kGo : kStop;
  const ssize_t count = ::send(socket_.get(), &what, 1, MSG_NOSIGNAL);
  if (count != 1 && errno != EAGAIN && errno != EINTR) note(errno);
  char error = 0;
  while (::recv(socket_.get(), &error, 1, 0) == 1) note(static_cast<unsigned char>(error));
}

void StopLine::note(int error) {
  if (std::exchange(said_, error) == error) return;
  const bool gone = error == EPIPE || error == ECONNRESET;
  const std::string what = gone ? "the process that has it was ended; start the run again" : std::strerror(error);
  messages_.push_back(fmt::format("the STOP line {} does not follow any more: {}", name_, what));
}

void StopLine::end(base::Time /*now*/) {
  if (!socket_.open()) return;
  send(false);
  socket_.close();
  ::waitpid(process_, nullptr, 0);
}

std::vector<std::string> StopLine::messages() { return std::exchange(messages_, {}); }

}  // namespace fencepost::host
