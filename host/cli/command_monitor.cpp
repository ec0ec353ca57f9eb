#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <memory>

#include "firmware/record/stream_reader.hpp"
#include "hal/linux/clock.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/replay_run.hpp"
#include "host/cli/stop_signals.hpp"
#include "host/cli/system.hpp"
#include "host/cli/terminal.hpp"
#include "host/monitor/believed.hpp"
#include "host/monitor/log_player.hpp"
#include "host/monitor/screen.hpp"
#include "host/monitor/terminal_screen.hpp"

namespace fencepost::host::cli {
namespace {

constexpr double kFrame = 0.1;  ///< s between two screens: what ssh and an eye can follow
constexpr double kSlowest = 1.0 / 16;
constexpr double kFastest = 64;

struct MonitorRequest {
  std::string what;
  std::string camera;
  double speed = 1;
  std::uint32_t baud = 115'200;
  bool no_command = false;
  bool wait = false;
  bool no_bell = false;
  bool plain = false;
  ReplayOptions options;
};

/// "   4.450 s  NOTICE  red  0.99 m  10 deg left", as replay prints them.
void print(const monitor::Said& said) {
  const std::string line = fmt::format("{:8.3f} s  {}\n", said.t, said.text);
  for (std::string_view rest = line; !rest.empty();) {
    const ssize_t count = ::write(STDOUT_FILENO, rest.data(), rest.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Failure(Exit::kDone, "");  // the reader has gone
    rest.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Bytes to records; other lines are heard as they are.
class ScreenFeed {
 public:
  explicit ScreenFeed(monitor::Believed& believed) : believed_(believed) {}

  void take(std::string_view bytes) {
    for (const char byte : bytes) {
      const auto outcome = reader_.push(byte, believed_);
      if (byte != '\n') {
        if (line_.size() < record::kMaxLine) line_ += byte;
        continue;
      }
      if (outcome && !line_.starts_with("$FP")) {
        if (line_.ends_with('\r')) line_.pop_back();
        believed_.hear(line_);
      }
      line_.clear();
    }
  }

 private:
  monitor::Believed& believed_;
  std::array<char, record::StreamReader::kBuffer> buffer_{};
  record::StreamReader reader_{buffer_};
  std::string line_;
};

/// A source of records: a log or a port.
class Source {
 public:
  virtual ~Source() = default;
  /// Takes what has come until now; `now` in s of this machine's clock. The source's descriptor wakes the loop.
  virtual void feed(double now) = 0;
  [[nodiscard]] virtual bool ended() const = 0;
  [[nodiscard]] virtual int descriptor() const { return -1; }
  [[nodiscard]] virtual std::string state() const = 0;
  [[nodiscard]] virtual std::string keys() const = 0;
  virtual void key(char /*typed*/, double /*now*/) {}
};

class PlayedSource final : public Source {
 public:
  PlayedSource(std::string log, double speed, ScreenFeed& feed) : player_(std::move(log)), feed_(feed), speed_(speed) {}

  void feed(double now) override {
    if (!paused_) at_ += (now - before_.value_or(now)) * speed_;
    before_ = now;
    const double until = speed_ == 0 ? HUGE_VAL : at_;
    while (const auto line = player_.next(until)) feed_.take(*line);
  }
  [[nodiscard]] bool ended() const override { return player_.ended(); }
  [[nodiscard]] std::string state() const override {
    if (player_.ended()) return "end";
    return paused_ ? "paused" : fmt::format("x{:g}", speed_);
  }
  [[nodiscard]] std::string keys() const override { return "q quit  space pause  + - speed  r again"; }
  void key(char typed, double now) override {
    if (typed == ' ') paused_ = !paused_;
    if (typed == '+' || typed == '=') speed_ = std::min(kFastest, speed_ * 2);
    if (typed == '-') speed_ = std::max(kSlowest, speed_ / 2);
    if (typed == 'r') {
      player_.rewind();
      at_ = 0;
      before_ = now;
      paused_ = false;
    }
  }

 private:
  monitor::LogPlayer player_;
  ScreenFeed& feed_;
  double speed_;
  double at_ = 0;  ///< s of the log
  std::optional<double> before_;
  bool paused_ = false;
};

/// Asks for mode log as `record` does: at the start, and a few times more until a record comes. Boards restart when
/// their port is opened.
class PortSource final : public Source {
 public:
  PortSource(std::unique_ptr<BytePort> port, const MonitorRequest& request, monitor::Believed& believed,
             ScreenFeed& feed)
      : port_(std::move(port)),
        ends_(request.what == "-"),
        asks_(!request.no_command && !ends_),
        believed_(believed),
        feed_(feed) {}

  void feed(double now) override {
    port_->tend(base::Time::nearest(now));
    if (port_->connected() && !connected_) asked_ = 0;
    connected_ = port_->connected();
    if (!connected_) return;
    ask(now);
    std::array<std::uint8_t, 4096> buffer{};
    while (const auto count = port_->read(buffer)) {
      if (*count == 0) break;
      feed_.take({reinterpret_cast<const char*>(buffer.data()), *count});
    }
  }
  [[nodiscard]] bool ended() const override { return ends_ && !port_->connected(); }
  [[nodiscard]] int descriptor() const override { return port_->descriptor(); }
  [[nodiscard]] std::string state() const override {
    if (ended()) return "end";
    if (!port_->connected()) return "unplugged";
    return believed_.t() == 0 ? "nothing yet" : "";
  }
  [[nodiscard]] std::string keys() const override { return "q quit"; }

 private:
  void ask(double now) {
    constexpr double kEvery = 3;  // s
    constexpr int kMax = 5;
    if (!asks_ || asked_ >= kMax || (asked_ > 0 && (believed_.beat() || now < asked_at_ + kEvery))) return;
    constexpr std::string_view kAsk = "\rmode log\r";
    static_cast<void>(port_->write({reinterpret_cast<const std::uint8_t*>(kAsk.data()), kAsk.size()}));
    asked_at_ = now;
    ++asked_;
  }

  std::unique_ptr<BytePort> port_;
  bool ends_;  ///< with the port
  bool asks_;
  bool connected_ = false;
  int asked_ = 0;
  double asked_at_ = 0;
  monitor::Believed& believed_;
  ScreenFeed& feed_;
};

bool is_port(const std::string& what) { return what == "-" || what.starts_with("tcp:") || names_device(what); }

/// The log that the robot's loop writes of these inputs: its beliefs, even if the log itself has none.
std::string own_log(const MonitorRequest& request) {
  ReplayOptions options = request.options;
  if (!request.camera.empty()) options.camera = read_camera(request.camera);
  std::string log;
  options.log = [&](std::string_view line) { log += line; };
  options.most_poses = 2;
  LogInput input(request.what);
  ReplayProgress progress(input);
  const auto next = [&] {
    if (log.size() > kMaxWhole) refuse_long_log(request.what);
    return progress.next();
  };
  const ReplayOutcome outcome = replay(next, input_name(request.what), options);
  if (outcome.unreadable) throw Failure(Exit::kUnreadable, outcome.unreadable->message);
  say_what_was_left_out(outcome);
  return log;
}

/// Runs until a key, a signal, or the source's end; `tick(now)` draws the screen.
template <class Tick>
void loop(Source& source, const StopSignals& signals, bool keys, Tick tick) {
  const linux::MonotonicClock clock;
  while (StopSignals::caught() == 0) {
    const double now = clock.now().to_double();
    source.feed(now);
    if (!tick(now)) return;
    std::array<pollfd, 3> wait{{{signals.descriptor(), POLLIN, 0},
                                {source.ended() ? -1 : source.descriptor(), POLLIN, 0},
                                {keys ? STDIN_FILENO : -1, POLLIN, 0}}};
    ::poll(wait.data(), wait.size(), static_cast<int>(kFrame * 1000));
  }
}

void show_screen(Source& source, const monitor::Believed& believed, const MonitorRequest& request,
                 const StopSignals& signals) {
  monitor::TerminalScreen screen(colour_on_stdout());
  const bool keys = screen.has_keys() && request.what != "-";
  record::AlertLevel before = record::AlertLevel::kClear;
  double shown = -kFrame;
  loop(source, signals, keys, [&](double now) {
    for (const char typed : keys ? screen.keys() : std::string()) {
      if (typed == 'q' || typed == 'Q') return false;
      source.key(typed, now);
      shown = now - kFrame;
    }
    if (now < shown + kFrame && !source.ended()) return true;
    shown = now;
    const record::AlertLevel level = believed.level();
    const bool bell = !request.no_bell && level >= record::AlertLevel::kStop && before < record::AlertLevel::kStop;
    before = level;
    const std::string name = request.what == "-" ? "standard input" : request.what;
    return screen.show(monitor::screen_of(believed, {name, source.state(), keys ? source.keys() : ""},
                                          monitor::TerminalScreen::size()),
                       bell) &&
           (keys || !source.ended());
  });
}

Exit watch(const MonitorRequest& request) {
  const bool screen = !request.plain && is_terminal(STDOUT_FILENO) && can_redraw();
  const bool port = is_port(request.what);
  StopSignals signals;
  monitor::Believed believed(screen ? std::function<void(const monitor::Said&)>() : print);
  ScreenFeed feed(believed);
  std::unique_ptr<Source> source;
  if (port) {
    source =
        std::make_unique<PortSource>(open_console(request.what, request.baud, request.wait), request, believed, feed);
  } else {
    source = std::make_unique<PlayedSource>(own_log(request), request.speed, feed);
  }
  if (screen) {
    signals.on_second(monitor::TerminalScreen::give_back);
    show_screen(*source, believed, request, signals);
  } else {
    loop(*source, signals, false, [&](double) { return !source->ended(); });
  }
  const int caught = StopSignals::caught();
  return caught == 0 || caught == SIGTERM ? Exit::kDone : Exit::kInterrupted;
}

Exit run(const MonitorRequest& request) {
  if (request.camera == "-" && request.what == "-") {
    throw Failure(Exit::kUsage, "PORT and --camera cannot both be standard input; put one into a file");
  }
  if (is_port(request.what) && (!request.camera.empty() || !request.options.profile.empty() || request.speed != 1)) {
    throw Failure(Exit::kUsage, "--camera, --profile and --speed are about a LOG; a robot at a PORT knows its own");
  }
  return watch(request);
}

Action configure_monitor(Options command) {
  const auto request = std::make_shared<MonitorRequest>();
  command
      .positional("PORT|LOG", request->what,
                  "the robot's console: a serial port, tcp:HOST:PORT, - for standard input; or a recorded stream")
      .required();
  command.value("--speed", request->speed, "of a log; default 1: as it was; 0: as fast as it goes")
      .takes("F")
      .within(0.0, kFastest);
  command.flag("--plain", request->plain, "lines instead of a screen, as where standard output is no terminal");
  command.flag("--no-bell", request->no_bell, "no bell when it says STOP");
  command.value("--baud", request->baud, "of a serial port; default: 115200").takes("N").positive();
  command.flag("--no-command", request->no_command, "do not ask a robot for mode log");
  command.flag("--wait", request->wait, "wait for a port that is not there yet");
  command.profile(request->options.profile, "of a log: capacities of the robot; default: the log's, else full");
  command.log_camera(request->camera);
  return [request] { return run(*request); };
}

}  // namespace

Command monitor_command() {
  return {"monitor",
          "what a robot believes, live in this terminal: map, objects, alert, links",
          "  fencepost monitor /dev/ttyACM0\n"
          "  fencepost monitor run.log --speed 4\n"
          "  ssh robot cat /dev/ttyACM0 | fencepost monitor -\n"
          "  fencepost monitor run.log --speed 0 | grep STOP\n",
          configure_monitor,
          {}};
}

}  // namespace fencepost::host::cli
