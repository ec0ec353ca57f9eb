#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <filesystem>
#include <memory>

#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/record_devices.hpp"
#include "host/cli/stop_signals.hpp"
#include "host/cli/terminal.hpp"
#include "host/recorder/recorder.hpp"
#include "host/recorder/status_text.hpp"
#include "host/text/plural.hpp"

namespace fencepost::host::cli {
namespace {

struct RecordRequest {
  std::string port;
  std::string camera;
  std::string odometry;
  std::string robot;
  std::string colours;
  std::string output;
  std::uint32_t baud = 115'200;
  std::string mode = "log";
  bool reset = false;
  bool no_command = false;
  bool wait = false;
  bool quiet = false;
  PartOptions parts;
  std::optional<double> seconds;
};

[[nodiscard]] bool of_devices(const RecordRequest& request) {
  return !request.camera.empty() || !request.odometry.empty();
}

void check_devices(const RecordRequest& request) {
  if (request.camera.empty() || request.odometry.empty()) {
    throw Failure(Exit::kUsage, "a recording of devices needs both --camera and --odometry");
  }
  if (!request.port.empty()) {
    throw Failure(Exit::kUsage,
                  "a PORT is a robot's console, which has its camera and wheels; leave out one or the other");
  }
  if (request.no_command || request.reset) {
    throw Failure(Exit::kUsage, "--reset and --no-command are about a PORT; with --camera each recording is a new run");
  }
}

void check_usage(const RecordRequest& request) {
  if (of_devices(request)) {
    check_devices(request);
  } else if (request.port.empty()) {
    throw Failure(Exit::kUsage,
                  "name a PORT, such as /dev/ttyACM0, or --camera and --odometry; see fencepost record --help");
  } else if (!request.robot.empty() || !request.colours.empty()) {
    throw Failure(Exit::kUsage,
                  "--robot and --colours go with --camera and --odometry; a robot at a PORT knows its own numbers");
  }
  if (is_standard_output(request.output)) {
    throw Failure(Exit::kUsage,
                  "a recording needs a file; standard output shows its lines anyway: name a file with -o");
  }
  if (request.no_command && request.reset) {
    throw Failure(Exit::kUsage, "--reset is a command, and --no-command forbids them; leave one out");
  }
}

/// fencepost-20260131-235959.log, or with a number where that exists.
std::string default_name() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  const std::string stem = fmt::format("fencepost-{:04}{:02}{:02}-{:02}{:02}{:02}", local.tm_year + 1900,
                                       local.tm_mon + 1, local.tm_mday, local.tm_hour, local.tm_min, local.tm_sec);
  std::string name = stem + ".log";
  std::error_code unknown;  // opening the log says what is wrong with this folder
  for (int i = 2; std::filesystem::exists(name, unknown); ++i) name = fmt::format("{}-{}.log", stem, i);
  return name;
}

std::string file_name(const RecordRequest& request) { return request.output.empty() ? default_name() : request.output; }

/// The empty line terminates a partly typed one.
std::string greeting(const RecordRequest& request) {
  if (request.no_command || request.port == "-") return {};
  return "\rmode " + request.mode + "\r" + (request.reset ? "reset\r" : "");
}

RecorderSettings recorder_settings(const RecordRequest& request) {
  RecorderSettings settings;
  settings.port_name = request.port == "-" ? "standard input" : request.port;
  settings.greeting = greeting(request);
  settings.ends_with_port = request.port == "-";
  if (request.seconds) settings.length = base::Duration::nearest(*request.seconds);
  return settings;
}

template <class T>
T opened(linux::Opened<T> what) {
  if (!what) throw Failure(Exit::kDevice, what.problem());
  return std::move(*what);
}

/// "run.log", or "run.log to run-0003.log".
std::string parts_name(const std::string& first, const LogFile& log) {
  return first == log.path() ? first : first + " to " + log.path();
}

void say_end(const Recorder& recorder, const std::string& saved, const Display& display, base::Time now) {
  for (const std::string& line : summary(recorder.tally(), now)) say(line);
  if (display.lines_not_shown() > 0) {
    say(plural(display.lines_not_shown(), "line") + " of the file not shown: standard output was too slow");
  }
  say("saved in " + saved);
}

/// For a service, being stopped is success.
Exit exit_code(const RecordingEnd& end) {
  return end.signal == 0 || end.signal == SIGTERM ? Exit::kDone : Exit::kInterrupted;
}

Exit record_console(const RecordRequest& request) {
  const linux::MonotonicClock clock;
  StopSignals signals;
  const std::unique_ptr<BytePort> port = open_console(request.port, request.baud, request.wait);
  const std::string name = file_name(request);
  LogFile log = opened(
      LogFile::open({.path = name, .part_bytes = request.parts.bytes(), .part_age = request.parts.age()}, clock.now()));

  const bool status = is_terminal(STDERR_FILENO) && can_redraw();
  Display display({!request.quiet, is_terminal(STDOUT_FILENO), status});
  std::optional<Keyboard> keyboard;
  if (request.port != "-") keyboard.emplace(status && is_terminal(STDIN_FILENO));
  signals.on_second(Keyboard::give_back_terminal);
  RecorderSettings settings = recorder_settings(request);
  say(fmt::format("recording {} in {}; Ctrl-C ends it", settings.port_name, log.path()));
  if (!port->connected() && !port->problem().empty()) say("waiting for it: " + port->problem());

  Recorder recorder(
      {*port, log, display, keyboard ? &*keyboard : nullptr, StopSignals::caught(), signals.descriptor(), clock},
      std::move(settings));
  const RecordingEnd end = recorder.run();
  keyboard.reset();
  say_end(recorder, parts_name(name, log), display, clock.now());
  if (end.fault) throw Failure(Exit::kDevice, end.fault->sentence);
  if (request.port == "-" && !port->problem().empty()) throw Failure(Exit::kUnreadable, port->problem());
  return exit_code(end);
}

Exit run(const RecordRequest& request) {
  check_usage(request);
  if (!of_devices(request)) return record_console(request);
  return record_devices({.camera = request.camera,
                         .odometry = request.odometry,
                         .robot = request.robot,
                         .colours = request.colours,
                         .log = file_name(request),
                         .part_bytes = request.parts.bytes(),
                         .part_age = request.parts.age(),
                         .wait = request.wait,
                         .seconds = request.seconds});
}

Action configure_record(Options command) {
  const auto request = std::make_shared<RecordRequest>();
  command.positional("PORT", request->port,
                     "the robot's console: a serial port, tcp:HOST:PORT, or - for standard input");
  command.value("--camera", request->camera, "instead of PORT: a camera of this machine, as `run` takes it")
      .takes("DEV");
  command.value("--odometry", request->odometry, "with --camera: the wheels, as `run` takes them").takes("DEV");
  command.value("--robot", request->robot, "with --camera: the robot's numbers (JSON)").takes("FILE");
  add_colours(command, request->colours);
  command.value("-o,--output", request->output, "a new file; default: fencepost-YYYYMMDD-HHMMSS.log in this folder")
      .takes("FILE");
  request->parts.add_to(command);
  command.value("--baud", request->baud, "of a serial port; default: 115200").takes("N").positive();
  command.value("--mode", request->mode, "console mode asked for at the start; only log can be replayed; default: log")
      .one_of({"log", "text", "plot", "quiet"});
  command.flag("--reset", request->reset, "also ask for a new run, so that replay --check can compare all of it");
  command.flag("--no-command", request->no_command, "send nothing but what is typed");
  command.flag("--wait", request->wait, "wait for a port that is not there yet");
  command.value("--seconds", request->seconds, "end after so long").takes("T").positive();
  command.flag("-q,--quiet", request->quiet, "do not show the lines");
  return [request] { return run(*request); };
}

}  // namespace

Command record_command() {
  return {"record",
          "a robot's console into a file, as it comes",
          "  fencepost record /dev/ttyACM0\n"
          "  fencepost record /dev/ttyACM0 --reset --seconds 60 -o run.log && fencepost replay run.log --check\n"
          "  fencepost record tcp:robot.local:2000 -o run.log --seconds 60 -q\n"
          "  fencepost record --camera pixy2:/dev/ttyUSB0 --odometry create2:/dev/ttyUSB1 --robot robot.json\n"
          "  ssh robot cat /dev/ttyACM0 | fencepost record - -o run.log\n",
          configure_record,
          {}};
}

}  // namespace fencepost::host::cli
