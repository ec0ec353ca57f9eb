#include <unistd.h>

#include <charconv>
#include <memory>

#include "hal/linux/gpio_line.hpp"
#include "host/cli/command.hpp"
#include "host/cli/files.hpp"
#include "host/cli/live_devices.hpp"
#include "host/cli/open_run_log.hpp"
#include "host/cli/page_file.hpp"
#include "host/cli/stop_signals.hpp"
#include "host/cli/terminal.hpp"
#include "host/live/alert_command.hpp"
#include "host/live/can_alert.hpp"
#include "host/live/listening_console.hpp"
#include "host/live/run.hpp"
#include "host/live/stop_line.hpp"
#include "host/recorder/typing_console.hpp"
#include "host/view/request.hpp"
#include "host/view/view_server.hpp"

namespace fencepost::host::cli {
namespace {

struct RunRequest {
  std::string camera;
  std::string odometry;
  std::string console = "-";
  std::string robot;
  std::string colours;
  std::string log;
  std::string mode;
  std::string profile = "full";
  std::string on_alert;
  std::string stop_gpio;
  std::string alert_can;
  std::optional<std::string> view;  ///< its port; empty: any
  PartOptions parts;
  std::optional<double> seconds;
  std::optional<std::uint64_t> frames;
  bool force = false;
  bool wait = false;
};

ConsoleSpec console_of(const RunRequest& request) {
  const auto spec = parse_console(request.console);
  if (!spec.ok()) throw Failure(Exit::kUsage, spec.error());
  return *spec;
}

console::Mode mode_of(const RunRequest& request, const ConsoleSpec& console) {
  for (std::size_t i = 0; i < console::kModes; ++i) {
    if (request.mode == console::name(static_cast<console::Mode>(i))) return static_cast<console::Mode>(i);
  }
  const bool people =
      console.kind != ConsoleSpec::Kind::kTerminal || is_terminal(STDOUT_FILENO) || !request.log.empty();
  return people ? console::Mode::kText : console::Mode::kLog;
}

RunPlan plan_of(const RunRequest& request, const ConsoleSpec& console) {
  RunPlan plan;
  plan.robot = read_robot(request.robot, request.colours);
  plan.profile = request.profile;
  plan.mode = mode_of(request, console);
  plan.version = FENCEPOST_VERSION;
  plan.frames = request.frames;
  if (request.seconds) plan.duration = base::Duration::nearest(*request.seconds);
  plan.console_is_people = console.kind == ConsoleSpec::Kind::kTerminal;
  return plan;
}

RunLogSettings log_of(const RunRequest& request) {
  RunLogSettings settings;
  settings.path = request.log;
  settings.overwrite = request.force;
  settings.profile = request.profile;
  settings.part_age = request.parts.age();
  settings.part_bytes = request.parts.bytes();
  if (request.log.empty() && (request.parts.given() || request.force)) {
    throw Failure(Exit::kUsage, "--log-size, --log-minutes and --force say something of --log; name a file with it");
  }
  if (is_standard_output(request.log)) {
    throw Failure(Exit::kUsage, "--log takes a file; for the log on standard output use --mode log");
  }
  return settings;
}

std::unique_ptr<ConsolePort> open(const ConsoleSpec& spec, bool wait) {
  const bool typed = spec.kind == ConsoleSpec::Kind::kTerminal && is_terminal(STDIN_FILENO);
  if (typed && is_terminal(STDOUT_FILENO) && can_redraw()) return std::make_unique<TypingConsole>(colour_on_stdout());
  try {
    auto console = open_console(spec, wait);
    if (const auto* pty = dynamic_cast<const PtyConsole*>(console.get())) say("console at " + pty->path());
    if (const auto* port = dynamic_cast<const ListeningConsole*>(console.get())) say("console at " + port->address());
    return console;
  } catch (const DeviceFailure& failure) {
    throw Failure(Exit::kDevice, failure.message);
  }
}

void say_what_is_assumed(const RunPlan& plan, const Devices& devices) {
  if (!devices.intrinsics) {
    say("the camera's calibration is not known: frames are refused until an $FPCAM line comes, or give --robot FILE");
  } else if (!plan.robot.camera.mount) {
    say("where the camera sits is not known: it is taken to be above the robot's middle, looking ahead; give --robot "
        "FILE with \"camera\": {\"mount\": ...}");
  }
}

/// A person sits at the console.
bool typed_at(const RunPlan& plan) {
  return plan.console_is_people && is_terminal(STDIN_FILENO) && is_terminal(STDOUT_FILENO);
}

using Outputs = std::vector<std::unique_ptr<AlertOutput>>;

/// Requested outputs besides the console, checked before anything is opened.
struct OutputSpecs {
  std::optional<StopLineSpec> line;
  std::optional<CanAlertSpec> can;
};

OutputSpecs output_specs_of(const RunRequest& request) {
  OutputSpecs specs;
  if (!request.stop_gpio.empty()) {
    const auto line = parse_stop_line(request.stop_gpio);
    if (!line.ok()) throw Failure(Exit::kUsage, line.error());
    specs.line = *line;
  }
  if (!request.alert_can.empty()) {
    const auto can = parse_can_alert(request.alert_can);
    if (!can.ok()) throw Failure(Exit::kUsage, can.error());
    specs.can = *can;
  }
  return specs;
}

/// Before devices are opened: they have threads, and a robot without its camera must stay stationary.
void add_stop_line(Outputs& outputs, const StopLineSpec& spec) {
  auto line = linux::open_gpio_line({spec.chip, spec.line, spec.active_high});
  if (!line) throw Failure(Exit::kDevice, line.problem());
  auto held = StopLine::hold(std::move(*line), spec.active_high, spec.chip + ":" + spec.line);
  if (!held) throw Failure(Exit::kDevice, held.problem());
  outputs.push_back(std::move(*held));
}

void add_can(Outputs& outputs, const CanAlertSpec& spec, bool wait) {
  try {
    outputs.push_back(std::make_unique<CanAlert>(spec, open_frame_sink(spec, wait)));
  } catch (const DeviceFailure& failure) {
    throw Failure(Exit::kDevice, failure.message + ", or --wait for it");
  }
}

std::unique_ptr<ViewServer> view_of(const RunRequest& request) {
  if (!request.view) return nullptr;
  std::uint16_t port = 0;
  const char* const end = request.view->data() + request.view->size();
  const auto [stopped, error] = std::from_chars(request.view->data(), end, port);
  if (!request.view->empty() && (error != std::errc() || stopped != end || port == 0)) {
    throw Failure(Exit::kUsage,
                  "--view takes a port, 1 to 65535, or nothing for any that is free; not " + *request.view);
  }
  ViewServer::Opened view = ViewServer::open(page_of_run("Run, live", kStreamPath), port);
  if (!view) throw Failure(Exit::kDevice, view.problem());
  return std::move(*view);
}

std::vector<AlertOutput*> borrowed(const Outputs& outputs) {
  std::vector<AlertOutput*> all;
  for (const auto& output : outputs) all.push_back(output.get());
  return all;
}

Exit exit_of(const RunSummary& summary) {
  if (summary.log_failed || summary.output_failed) return Exit::kDevice;
  const bool interrupted = summary.end == RunSummary::End::kInterrupted && StopSignals::caught() != SIGTERM;
  return interrupted ? Exit::kInterrupted : Exit::kDone;
}

/// Time for browsers to get the rest when the run ends.
constexpr std::chrono::milliseconds kLastLook{2'000};

Exit run(const RunRequest& request) {
  const ConsoleSpec console_spec = console_of(request);
  const DevicePair named = {device_of(request.camera, devices::Use::kCamera),
                            device_of(request.odometry, devices::Use::kOdometry)};
  const RunPlan plan = plan_of(request, console_spec);
  const RunLogSettings log_settings = log_of(request);
  const OutputSpecs wanted = output_specs_of(request);
  const std::unique_ptr<ViewServer> view = view_of(request);
  StopSignals signals;
  signals.on_second(Keyboard::give_back_terminal);
  const linux::MonotonicClock clock;
  Outputs outputs;
  if (wanted.line) add_stop_line(outputs, *wanted.line);
  Devices devices = open_devices_of(named, plan.robot, clock, request.wait);
  auto console = open(console_spec, request.wait);
  auto* const typing = dynamic_cast<TypingConsole*>(console.get());
  const auto say_there = [typing](std::string_view text) {
    typing != nullptr ? typing->without_typed_line([text] { say(text); }) : say(text);
  };
  const std::unique_ptr<WriteBehind> log = request.log.empty() ? nullptr : open_run_log(log_settings, clock.now());
  if (wanted.can) add_can(outputs, *wanted.can, request.wait);
  if (!request.on_alert.empty()) outputs.push_back(std::make_unique<AlertCommand>(request.on_alert));
  say_what_is_assumed(plan, devices);
  if (view != nullptr) say("the run is shown at " + view->address() + ": open it in a browser of this machine");
  if (typed_at(plan)) say("type help for the commands; Ctrl-C ends the run");
  const auto follower = [&view](std::string_view lines) {
    if (view != nullptr) view->add(lines);
  };
  const RunSummary summary = run_live(plan, {clock, devices, *console, log.get(), say_there, StopSignals::caught(),
                                             signals.descriptor(), borrowed(outputs), follower});
  console.reset();  // the terminal as it was
  if (StopSignals::caught() == SIGINT) leave_interrupted_line();
  say_lines(summary.sentence());
  if (view != nullptr) view->finish(kLastLook);
  return exit_of(summary);
}

Action configure_run(Options command) {
  const auto request = std::make_shared<RunRequest>();
  command
      .value("--camera", request->camera,
             "which camera, and where: KIND:PLACE[,option=value...]; fencepost devices lists the kinds")
      .takes("DEV")
      .required();
  command.value("--odometry", request->odometry, "which wheels, and where").takes("DEV").required();
  command.value("--robot", request->robot, "the robot's numbers: mount, colours, wheels (JSON)").takes("FILE");
  add_colours(command, request->colours);
  command
      .value("--console", request->console,
             "- (this terminal, the default), pty, tcp:HOST:PORT, tcp-listen:[HOST:]PORT, or /dev/tty...[,baud=N]")
      .takes("DEV");
  command
      .value("--mode", request->mode,
             "of the console; default: log where standard output is no terminal and there is no --log, else text")
      .one_of({"text", "log", "plot", "quiet"});
  command.value("--log", request->log, "write the whole record stream there, whatever the console shows").takes("FILE");
  request->parts.add_to(command);
  command.flag("--force", request->force, "overwrite an existing log");
  command.flag("--wait", request->wait, "wait for devices that are not there yet, instead of ending with exit code 4");
  command
      .value("--on-alert", request->on_alert,
             "at each change of the alert level in force, run CMD by the shell: $1 is the level, FENCEPOST_LEVEL, "
             "_ID, _COLOUR, _DISTANCE, _BEARING, _TTC, _CAMERA, _ODOMETRY and _TIME tell all of it")
      .takes("CMD");
  command
      .value("--stop-gpio", request->stop_gpio,
             "a GPIO line that stops the motors while it is low, and is high only while the robot may drive: "
             "CHIP:LINE[,active-high]")
      .takes("LINE");
  command
      .value("--alert-can", request->alert_can,
             "send the alert in force as a CAN frame, at each change and at least every 100 ms: INTERFACE[:ID], "
             "ID 120 by default (share/can/fencepost_alert.dbc)")
      .takes("IF");
  command
      .value("--view", request->view,
             "show the run in browsers of this machine, at http://127.0.0.1:PORT/; without a PORT at any that is free")
      .takes("[PORT]")
      .count(0, 1);
  command.profile(request->profile, "capacities; default: full");
  command.value("--frames", request->frames, "stop after the N-th frame record").takes("N").positive();
  command.value("--seconds", request->seconds, "stop after so long").takes("N").positive();
  return [request] { return run(*request); };
}

}  // namespace

Command run_command() {
  return {
      "run",
      "the robot's loop on this machine's cameras and wheels",
      "  fencepost run --camera pixy2:/dev/ttyUSB0 --odometry create2:/dev/ttyUSB1 --robot robot.json --log run.log\n"
      "  fencepost run --camera nxtcam:nxt,port=1 --odometry nxt:usb --wait\n"
      "  fencepost run --camera pixy2.1:/dev/i2c-1 --odometry can:can0 --robot robot.json --log run.log --log-size "
      "64M\n"
      "  fencepost run --camera pixy2:/dev/ttyUSB0 --odometry create2:/dev/ttyUSB1 --on-alert './motors \"$1\"'\n"
      "  fencepost run --camera pixy2:/dev/ttyUSB0 --odometry can:can0 --robot robot.json --stop-gpio gpiochip0:17 "
      "--alert-can can0\n"
      "  fencepost run --camera pixy2:/dev/ttyUSB0 --odometry create2:/dev/ttyUSB1 --view\n"
      "  fencepost run --camera console --odometry console < run.log\n",
      configure_run,
      {}};
}

}  // namespace fencepost::host::cli
