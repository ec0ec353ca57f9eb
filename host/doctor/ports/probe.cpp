#include "host/doctor/ports/probe.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "hal/linux/clock.hpp"
#include "hal/linux/wait.hpp"
#include "host/devices/catalogue.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::host::doctor {
namespace {

using devices::DeviceSpec;
using sensor::LinkState;

// Baud rates of the catalogue's cameras and wheels, the frequent ones first.
constexpr std::array<std::uint32_t, 8> kBauds = {9'600, 115'200, 57'600, 19'200, 38'400, 230'400, 4'800, 1'000'000};

/// A camera or wheels, by the interface that both share.
class Asked {
 public:
  Asked(const DeviceSpec& spec, const RobotFile& robot, linux::MonotonicClock clock) {
    const auto& driver = (*spec.row->live)->driver;
    const std::shared_ptr<SharedBrick> none;
    if (const auto* camera = std::get_if<devices::CameraDriver>(&driver)) {
      camera_ = (*camera->open)({spec, robot, none, clock, false});
      return;
    }
    const auto& wheels = std::get<devices::OdometryDriver>(driver);
    const std::shared_ptr<SharedBrick> brick = wheels.brick != nullptr ? wheels.brick(spec, false) : nullptr;
    wheels_ = (*wheels.open)({spec, robot, brick, clock, false});
  }

  [[nodiscard]] Device& device() {
    if (camera_) return *camera_;
    return *wheels_;
  }
  /// The number of blobs if a frame came, 0 if a sample of wheels came.
  std::optional<std::size_t> poll(base::Time now) {
    if (camera_) {
      const base::Result<sensor::BlobFrame> frame = camera_->poll(now);
      return frame ? std::optional(frame->blobs.size()) : std::nullopt;
    }
    return wheels_->poll(now) ? std::optional<std::size_t>(0) : std::nullopt;
  }

 private:
  std::unique_ptr<CameraDevice> camera_;
  std::unique_ptr<OdometryDevice> wheels_;
};

DeviceSpec at_baud(DeviceSpec spec, std::uint32_t baud) {
  spec.options["baud"] = std::to_string(baud);
  return spec;
}

bool has_option(const DeviceSpec& spec, std::string_view name) {
  return std::ranges::any_of(devices::options_of(*spec.row, spec.use),
                             [name](const devices::Option& option) { return *option.name == name; });
}

bool has_baud(const DeviceSpec& spec) { return spec.place.kind == PlaceKind::kTty && has_option(spec, "baud"); }

bool answers(LinkState state) { return sensor::works(state) || state == LinkState::kUnready; }

/// A wheel base may take a camera's bytes for half a command, and then not hear its own.
std::vector<const devices::Row*> wheels_first() {
  std::vector<const devices::Row*> rows = devices::rows_for(devices::Use::kOdometry);
  for (const devices::Row* row : devices::rows_for(devices::Use::kCamera)) rows.push_back(row);
  return rows;
}

/// Its white balance and gain: no frame comes before.
base::Duration settling_of(const DeviceSpec& spec) {
  return base::milliseconds(has_option(spec, "settle") ? 1'000 * static_cast<std::int64_t>(spec.number("settle")) : 0);
}

Probe ask(Asked& asked, linux::MonotonicClock clock, const ProbeTimes& times, base::Duration settling,
          const Interrupted& interrupted) {
  Probe probe;
  linux::WaitSet set;
  base::Time end = clock.now() + times.answer;
  std::optional<base::Time> since;
  for (base::Time now = clock.now(); !interrupted(); now = clock.now()) {
    if (now >= end) {
      if (since || asked.device().link() != LinkState::kUnready || settling.raw == 0) break;
      end = now + settling;
      settling = {};
    }
    asked.device().tend(now);
    const std::optional<std::size_t> told = asked.poll(now);
    if (told && !since) {
      since = now;
      end = now + times.measure;
    } else if (told) {
      ++probe.items;
      probe.blobs += *told;
      probe.rate = static_cast<double>(probe.items) / (now - *since).to_double();
    }
    if (told) continue;
    set.clear();
    asked.device().watch(set);
    set.wait_until(clock, now + asked.device().patience());
  }
  probe.link = asked.device().link();
  // A device that sent a frame or sample works, whatever it does just now.
  if (since && probe.link == LinkState::kSilent) probe.link = LinkState::kEmpty;
  return probe;
}

}  // namespace

Probe probe(const DeviceSpec& spec, const RobotFile& robot, const ProbeTimes& times, const Interrupted& interrupted) {
  const linux::MonotonicClock clock;
  try {
    Asked asked(spec, robot, clock);
    return ask(asked, clock, times, times.settling ? settling_of(spec) : base::Duration{}, interrupted);
  } catch (const DeviceFailure& failure) {
    if (failure.usage) throw;
    Probe none;
    none.problem = failure.message;
    return none;
  }
}

std::optional<std::uint32_t> find_baud(const DeviceSpec& spec, const RobotFile& robot, const ProbeTimes& times,
                                       const Interrupted& interrupted) {
  if (!has_baud(spec)) return std::nullopt;
  ProbeTimes shorter = times;
  shorter.answer = times.other_baud;
  shorter.settling = false;
  shorter.measure = base::milliseconds(100);
  for (const std::uint32_t baud : kBauds) {
    if (baud == spec.number("baud")) continue;
    if (interrupted()) break;
    const Probe found = probe(at_baud(spec, baud), robot, shorter, interrupted);
    if (found.problem.empty() && answers(found.link)) return baud;
  }
  return std::nullopt;
}

std::vector<DeviceSpec> who_answers(const std::string& path, const ProbeTimes& times, const Interrupted& interrupted) {
  ProbeTimes shorter = times;
  shorter.answer = times.other_baud;
  shorter.settling = false;
  shorter.measure = base::milliseconds(200);
  std::vector<DeviceSpec> working;
  std::vector<DeviceSpec> unready;
  for (const devices::Row* each : wheels_first()) {
    const devices::Row& row = *each;
    if (interrupted()) break;
    const auto& places = (*row.live)->places;
    if (std::ranges::find(places, PlaceKind::kTty) == places.end()) continue;
    const devices::Use use = *row.role == devices::Role::kCamera ? devices::Use::kCamera : devices::Use::kOdometry;
    const auto spec = devices::parse_device(*row.name + ":" + path, use);
    if (!spec.ok()) continue;
    try {
      const Probe answer = probe(*spec, {}, shorter, interrupted);
      if (answer.problem.empty() && sensor::works(answer.link)) working.push_back(*spec);
      if (answer.problem.empty() && answer.link == LinkState::kUnready) unready.push_back(*spec);
    } catch (const DeviceFailure&) {
      continue;  // it needs a robot file to be asked at all
    }
  }
  // An unready device may have misread another device's bytes as its own, so it counts only if nothing works.
  return working.empty() ? unready : working;
}

}  // namespace fencepost::host::doctor
