#include "host/cli/record_devices.hpp"

#include <fmt/format.h>

#include <csignal>

#include "host/cli/live_devices.hpp"
#include "host/cli/open_run_log.hpp"
#include "host/cli/stop_signals.hpp"
#include "host/cli/terminal.hpp"
#include "host/live/run.hpp"

namespace fencepost::host::cli {
namespace {

/// Nobody types, nobody listens.
class NoConsole final : public ConsolePort {
 public:
  base::Result<std::size_t> read(std::span<std::uint8_t> /*in*/) override { return base::Error::kNotReady; }
  base::Result<std::size_t> write(std::span<const std::uint8_t> out) override { return out.size(); }
  void tend(base::Time /*now*/) override {}
  [[nodiscard]] bool connected() const override { return true; }
  [[nodiscard]] std::string problem() const override { return {}; }
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] bool ended() const override { return true; }
};

devices::DeviceSpec device(const std::string& text, devices::Use use) {
  devices::DeviceSpec spec = device_of(text, use);
  if (spec.place.kind != PlaceKind::kNone) return spec;
  throw Failure(Exit::kUsage, "record has no console of its own; name the port whose lines are to be recorded");
}

RunPlan plan_of(const DeviceRecording& recording) {
  RunPlan plan;
  plan.robot = read_robot(recording.robot, recording.colours);
  plan.mode = console::Mode::kQuiet;
  plan.version = FENCEPOST_VERSION;
  if (recording.seconds) plan.duration = base::Duration::nearest(*recording.seconds);
  plan.console_is_people = true;
  plan.ends_without_log = true;
  return plan;
}

std::unique_ptr<WriteBehind> open_log(const DeviceRecording& recording, base::Time now) {
  RunLogSettings settings;
  settings.path = recording.log;
  settings.part_bytes = recording.part_bytes;
  settings.part_age = recording.part_age;
  settings.profile = RunPlan().profile;
  return open_run_log(settings, now);
}

}  // namespace

Exit record_devices(const DeviceRecording& recording) {
  const DevicePair named = {device(recording.camera, devices::Use::kCamera),
                            device(recording.odometry, devices::Use::kOdometry)};
  const RunPlan plan = plan_of(recording);
  const StopSignals signals;
  const linux::MonotonicClock clock;
  Devices devices = open_devices_of(named, plan.robot, clock, recording.wait);
  const std::unique_ptr<WriteBehind> log = open_log(recording, clock.now());
  say(fmt::format("recording {} and {} in {}; Ctrl-C ends it", named.camera.where(), named.odometry.where(),
                  log->name()));
  if (!devices.intrinsics) {
    say("the camera's calibration is not known: the log has no FPCAM, so replay needs --camera; or give --robot FILE");
  }
  NoConsole console;
  const RunSummary summary =
      run_live(plan, {clock, devices, console, log.get(), [](std::string_view text) { say(text); },
                      StopSignals::caught(), signals.descriptor()});
  if (StopSignals::caught() == SIGINT) leave_interrupted_line();
  say_lines(summary.sentence());
  if (summary.log_failed) return Exit::kDevice;
  const int signal = StopSignals::caught();
  return signal == 0 || signal == SIGTERM ? Exit::kDone : Exit::kInterrupted;
}

}  // namespace fencepost::host::cli
