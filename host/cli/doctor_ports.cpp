#include "host/cli/doctor_ports.hpp"

#include <fmt/format.h>

#include "host/cli/live_devices.hpp"
#include "host/cli/stop_signals.hpp"
#include "host/cli/system.hpp"
#include "host/cli/terminal.hpp"
#include "host/doctor/ports/access.hpp"
#include "host/doctor/ports/holders.hpp"
#include "host/doctor/ports/probe.hpp"
#include "host/doctor/ports/usb_guess.hpp"
#include "host/live/open_port.hpp"
#include "host/text/printable.hpp"

namespace fencepost::host::cli {
namespace {

using doctor::Finding;
using doctor::Findings;
using doctor::PortEntry;
using enum doctor::Severity;

/// The place as `run` takes it.
std::string written(const PortEntry& port) {
  if (port.kind == PlaceKind::kUsb) return "usb";
  return port.lasting.empty() ? port.path : port.lasting;
}

std::string described(const PortEntry& port) {
  if (!port.usb) return printable(port.detail);
  const doctor::UsbGuess guess = doctor::guess_usb(*port.usb, port.path);
  std::string own = port.usb->maker;
  own += (own.empty() || port.usb->name.empty() ? "" : " ") + port.usb->name;
  return fmt::format("{}  {}", doctor::usb_id(*port.usb), guess.name.empty() ? printable(own) : guess.name);
}

std::string next_step(const PortEntry& port) {
  if (port.usb) return "fencepost " + doctor::guess_usb(*port.usb, written(port)).try_next;
  if (port.kind == PlaceKind::kTty) return "fencepost doctor " + port.path;
  if (port.kind == PlaceKind::kI2c) return "fencepost doctor --camera pixy2:" + port.path;
  if (port.kind == PlaceKind::kSpi) return "fencepost doctor --camera pixy2:" + port.path;
  return "candump " + port.path;
}

void add_port(const PortEntry& port, PortExamination& found, Findings& findings) {
  std::optional<Finding> finding;
  if (port.kind != PlaceKind::kCan) finding = doctor::examine_node(port.path, {}, doctor::Identity::own());
  const std::string state = finding ? finding->code.str() : "";
  found.text += fmt::format("{:<24} {:<44} {}\n", port.path, described(port), finding ? "" : next_step(port));
  if (!port.lasting.empty()) found.text += fmt::format("{:<24} {}\n", "", port.lasting);
  nlohmann::ordered_json entry = {{"path", port.path}, {"lasting", port.lasting}, {"state", finding ? state : "free"}};
  if (port.usb) {
    entry["usb"] = {{"id", doctor::usb_id(*port.usb)},
                    {"name", printable(port.usb->name)},
                    {"maker", printable(port.usb->maker)},
                    {"serial", printable(port.usb->serial)}};
    entry["guess"] = doctor::guess_usb(*port.usb, port.path).name;
  }
  found.document["ports"].push_back(std::move(entry));
  if (finding) findings.push_back(*finding);
}

PortExamination finish(PortExamination found, const Findings& findings) {
  const std::string list = doctor::findings_text(findings);
  if (!found.text.empty() && !list.empty()) found.text += "\n";
  found.text += list;
  found.document["findings"] = doctor::findings_json(findings);
  if (doctor::has_fault(findings)) found.exit = Exit::kDevice;
  return found;
}

PortExamination start() {
  PortExamination found;
  found.document = {{"format", 1}, {"ports", nlohmann::ordered_json::array()}};
  return found;
}

PortExamination list_all() {
  PortExamination found = start();
  Findings findings;
  for (const PortEntry& port : doctor::list_ports({})) add_port(port, found, findings);
  if (found.document["ports"].empty()) {
    findings.push_back({kFault, "no_port", "no port is there",
                        "plug the device in and look at the end of 'dmesg'; a cable that only charges shows nothing"});
  }
  return finish(std::move(found), findings);
}

bool stopped() { return StopSignals::caught() != 0; }

Findings ask_everybody(const std::string& port) {
  const bool can_be_opened = !doctor::examine_node(port, {}, doctor::Identity::own());
  if (can_be_opened && is_terminal(STDERR_FILENO))
    say("asking each device of the catalogue at " + port + "; some ten seconds");
  return doctor::examine_port(port, {}, doctor::Identity::own(), {}, stopped);
}

Findings ask(const std::string& text, devices::Use use, const RobotFile& robot) {
  const devices::DeviceSpec spec = device_of(text, use);
  if (spec.place.kind == PlaceKind::kNone) {
    throw Failure(Exit::kUsage, "the console has no port of its own; name a device that has");
  }
  if (spec.place.kind == PlaceKind::kNxt) {
    throw Failure(Exit::kUsage, "a camera behind a brick cannot be asked alone; 'fencepost run' says how its link is");
  }
  try {
    return doctor::examine_device(spec, robot, {}, doctor::Identity::own(), {}, stopped);
  } catch (const DeviceFailure& failure) {
    throw Failure(Exit::kUsage, failure.message);
  }
}

}  // namespace

void PortRequestOptions::add_to(Options command) {
  command.value("--camera", camera, "how this camera is, as run names it: KIND:PLACE").takes("DEVICE");
  command.value("--odometry", odometry, "the same of wheels").takes("DEVICE");
  command.value("--robot", robot, "the robot file of run, for wheels that need one").takes("FILE");
  add_colours(command, colours);
}

bool names_port(const std::string& subject) {
  if (subject == "-" || subject.starts_with("/dev/std") || subject.starts_with("/dev/fd/")) return false;
  return names_device(subject);
}

PortExamination examine_ports(const std::string& port, const PortRequestOptions& options) {
  const StopSignals signals;
  if (!port.empty()) return finish(start(), ask_everybody(port));
  if (!options.names_devices()) return list_all();
  const RobotFile robot = read_robot(options.robot, options.colours);
  Findings findings;
  if (!options.camera.empty()) findings = ask(options.camera, devices::Use::kCamera, robot);
  if (!options.odometry.empty()) {
    const Findings wheels = ask(options.odometry, devices::Use::kOdometry, robot);
    findings.insert(findings.end(), wheels.begin(), wheels.end());
  }
  return finish(start(), findings);
}

}  // namespace fencepost::host::cli
