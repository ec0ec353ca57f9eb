#include "tests/studies/storm/bench.hpp"

#include <algorithm>
#include <stdexcept>

#include "drivers/can_wheels/layouts.hpp"
#include "firmware/config/colours.hpp"
#include "host/devices/emulated.hpp"
#include "host/devices/open_devices.hpp"
#include "tests/studies/storm/other_links.hpp"

namespace fencepost::test {
namespace {

using devices::Use;

constexpr base::Time kWorldBegins{20'000};  // 2 s: robots are switched on before they are moved
constexpr const char* kCan = "can";

devices::DeviceSpec spec_of(const std::string& text, Use use) {
  auto spec = devices::parse_device(text, use);
  if (!spec) throw std::runtime_error(spec.error());
  return *spec;
}

std::vector<Lap> laps_of(const Plan& plan) {
  std::vector<Lap> laps;
  for (const host::Scene& scene : plan.laps) laps.emplace_back(scene);
  return laps;
}

/// The camera's place, by which the catalogue distinguishes links.
std::string place_of(host::PlaceKind link) {
  switch (link) {
    case host::PlaceKind::kI2c: return "/dev/i2c-9";
    case host::PlaceKind::kSpi: return "/dev/spidev9.0";
    case host::PlaceKind::kUsb: return "usb";
    default: return "/storm/camera";
  }
}

std::string baud_of(const Plan& plan) { return plan.baud > 0 ? ",baud=" + std::to_string(plan.baud) : ""; }

// host/emulate has serial lines and CAN.
void put_on_link(emulate::EmulatedDevice& device, const Plan& plan) {
  if (plan.link == host::PlaceKind::kTty) return;
  device.baud = 0;  // as fast as it goes; a two-wire bus has a clock of its own
  const std::string row = plan.camera;
  if (plan.link == host::PlaceKind::kI2c) {
    device.make = [row](const emulate::Colours&) { return on_two_wires(row); };
    device.asked = true;
  } else if (plan.link == host::PlaceKind::kUsb) {
    device.make = [row](const emulate::Colours&) { return on_usb(row); };
    device.unit = kUsbTransfer;
    device.asked = true;
  }
}

/// Those of the emulated wheels.
can_wheels::Mapping can_mapping() {
  can_wheels::Mapping mapping;
  mapping.left = can_wheels::canopen_position(5);
  mapping.right = can_wheels::canopen_position(6);
  mapping.wheels.left_pm_per_count = mapping.wheels.right_pm_per_count = 100'000'000;
  mapping.wheels.track_pm = 235'000'000'000;
  return mapping;
}

}  // namespace

StormBench::StormBench(const Plan& plan) : plan_(plan), world_(laps_of(plan), plan.seed, kWorldBegins) {
  const emulate::Colours colours = [&configured = plan.configured](std::uint8_t id) -> std::optional<sensor::Rgb> {
    for (const record::Signature& signature : configured.signatures) {
      if (signature.signature == id) return signature.rgb;
    }
    return std::nullopt;
  };
  const std::string wheels = plan.wheels == kCan ? "can:can0" : plan.wheels;
  const std::string baud = baud_of(plan);
  const std::array<std::string, 2> names = {plan.camera + baud, wheels};
  const std::array<std::string, 2> places = {place_of(plan.link), "/storm/wheels"};
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    emulate::EmulatedDevice device = devices::emulated(spec_of(names.at(i), Use::kEmulated));
    if (i == index(Cable::kCamera)) put_on_link(device, plan);
    ends_.at(i).device.emplace(device, colours, plan.configured.camera, plan.seed + i, base::Time{});
    if (i == index(Cable::kCamera) && plan.link == host::PlaceKind::kUsb) ends_.at(i).device->live_on_cable();
    ends_.at(i).device->wires = plan.wires;
    sockets_.plug_in(places.at(i), *ends_.at(i).device);
    world_.add(*ends_.at(i).device);
  }
}

host::Devices StormBench::open_devices() {
  host::RobotFile robot;
  robot.camera.mount = plan_.configured.camera.mount;
  robot.signatures = plan_.configured.signatures;
  for (const record::Signature& signature : robot.signatures) {
    robot.windows.push_back(config::window_around(signature));
  }
  const bool can = plan_.wheels == kCan;
  const devices::DeviceSpec camera = spec_of(plan_.camera + ":" + place_of(plan_.link) + baud_of(plan_), Use::kCamera);
  const devices::DeviceSpec wheels = spec_of(can ? "console" : plan_.wheels + ":/storm/wheels", Use::kOdometry);
  auto opened = devices::open_devices(camera, wheels, robot, linux::MonotonicClock(), true);
  if (const auto* failure = std::get_if<host::DeviceFailure>(&opened)) throw std::runtime_error(failure->message);
  host::Devices devices = std::move(std::get<host::Devices>(opened));
  if (!can) return devices;
  devices.odometry = open_can_wheels("/storm/wheels", can_mapping());
  devices.odometry->introduce({"odometry can", kCan, "can0", "", ""});
  return devices;
}

void StormBench::begin(const Event& event, base::Time now) {
  End& end = ends_.at(index(event.cable));
  const base::Time until = now + base::milliseconds(event.length);
  const auto last = [until](std::optional<base::Time>& time) { time = std::max(time.value_or(until), until); };
  end.line.disturbed = std::max(end.line.disturbed, until);
  switch (event.kind) {
    case EventKind::kNoise:
      end.device->set_noise(event.amount);
      last(end.noise_ends);
      break;
    case EventKind::kHostile: end.device->inject(static_cast<std::uint64_t>(event.amount), event.seed); break;
    case EventKind::kStall:
      end.device->set_stalled(true);
      last(end.stall_ends);
      end.line.held = std::max(end.line.held, until);
      break;
    case EventKind::kUnplug:
      if (end.line.plugged) end.line.since = now;
      end.line.plugged = false;
      end.device->set_plugged(false);
      last(end.unplug_ends);
      break;
    case EventKind::kReboot:
      end.device->set_power(false, now);
      last(end.reboot_ends);
      break;
    case EventKind::kFreeze:
      end.device->set_frozen(true);
      last(end.freeze_ends);
      break;
    default: break;
  }
}

void StormBench::end_events(base::Time now) {
  const auto over = [now](std::optional<base::Time>& time) {
    if (!time || *time > now) return false;
    time.reset();
    return true;
  };
  for (End& end : ends_) {
    if (over(end.noise_ends)) end.device->set_noise(0);
    if (over(end.stall_ends)) end.device->set_stalled(false);
    if (over(end.freeze_ends)) end.device->set_frozen(false);
    if (over(end.reboot_ends)) end.device->set_power(true, now);
    if (!over(end.unplug_ends)) continue;
    end.line.plugged = true;
    end.line.since = now;
    end.device->set_plugged(true);
  }
}

}  // namespace fencepost::test
