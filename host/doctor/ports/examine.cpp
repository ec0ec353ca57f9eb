#include <fmt/format.h>

#include "host/doctor/ports/access.hpp"
#include "host/doctor/ports/holders.hpp"
#include "host/doctor/ports/probe.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::host::doctor {
namespace {

using devices::DeviceSpec;
using enum Severity;
using sensor::LinkState;

/// The device node of this place; empty for a place without one.
std::string node_of(const DeviceSpec& spec) {
  switch (spec.place.kind) {
    case PlaceKind::kTty:
    case PlaceKind::kI2c:
    case PlaceKind::kSpi: return spec.place.name;
    default: return {};
  }
}

bool runs_udev(const Roots& roots) {
  std::error_code none;
  return std::filesystem::exists(roots.run / "udev" / "data", none);
}

Finding about_holders(const std::string& path, const Roots& roots) {
  const Holders holders = holders_of(roots, path);
  return {kFault, "busy", fmt::format("{} is in use by {}", path, holders_text(holders)),
          holders_remedy(holders, path)};
}

Finding cannot_open(const DeviceSpec& spec, const Probe& probe, const Roots& roots) {
  const std::string node = node_of(spec);
  if (!node.empty() && probe.problem.find("in use") == std::string::npos &&
      probe.problem.find("another program") == std::string::npos) {
    return {kFault, "cannot_open", probe.problem, ""};
  }
  if (!node.empty()) return about_holders(node, roots);
  const bool busy = probe.problem.find("another program") != std::string::npos;
  const bool denied = probe.problem.find("udev") != std::string::npos;
  return {kFault, busy ? Code("busy") : denied ? Code("no_permission") : Code("no_port"), probe.problem, ""};
}

std::string heard(const DeviceSpec& spec, const Probe& probe) {
  const bool camera = *spec.row->role == devices::Role::kCamera;
  if (probe.items == 0) return "works";
  const double blobs = static_cast<double>(probe.blobs) / static_cast<double>(probe.items);
  return fmt::format("works: {:.0f} {} a second{}", probe.rate, camera ? "frames" : "poses",
                     camera ? fmt::format(", {:.1f} blobs each", blobs) : "");
}

Finding about_link(const DeviceSpec& spec, const RobotFile& robot, const Probe& probe, const ProbeTimes& times,
                   const Interrupted& interrupted) {
  const std::string where = spec.where();
  switch (probe.link) {
    case LinkState::kOk: return {kNote, "fine", where + " " + heard(spec, probe), ""};
    case LinkState::kEmpty:
      if (probe.blobs > 0 || *spec.row->role != devices::Role::kCamera) {
        return {kNote, "fine", where + " " + heard(spec, probe), ""};
      }
      return {kNote, "nothing_seen", where + " works and sees nothing", "put something of a trained colour before it"};
    case LinkState::kUnready:
      return {kFault, "unready", where + " answers but is not ready", *(*spec.row->live)->unready};
    case LinkState::kSilent:
    case LinkState::kAbsent: break;
  }
  if (const auto baud = find_baud(spec, robot, times, interrupted)) {
    return {kFault, "wrong_baud",
            fmt::format("{} is silent at {} baud and answers at {}", where, spec.number("baud"), *baud),
            fmt::format("write {}:{},baud={}", spec.kind_name(), spec.place.name, *baud)};
  }
  return {kFault, "silent", where + " is silent", std::string(silent_remedy(spec.place.kind))};
}

}  // namespace

std::optional<Finding> examine_node(const std::string& path, const Roots& roots, const Identity& who) {
  const std::optional<Node> node = node_at(path);
  if (!node) {
    return Finding{kFault, "no_port", path + " is not there",
                   "plug it in and switch it on; 'fencepost doctor' lists what is there. A cable that only charges "
                   "shows nothing"};
  }
  if (!may_open(*node, who)) {
    return Finding{kFault, "no_permission",
                   fmt::format("{} belongs to {}, and {} may not open it", path, node->group_name,
                               who.name.empty() ? "this user" : who.name),
                   permission_remedy(*node, who, usb_of_tty(roots, path), runs_udev(roots))};
  }
  const Holders holders = holders_of(roots, path);
  if (!holders.programs.empty()) return about_holders(path, roots);
  return std::nullopt;
}

Findings examine_device(const DeviceSpec& spec, const RobotFile& robot, const Roots& roots, const Identity& who,
                        const ProbeTimes& times, const Interrupted& interrupted) {
  const std::string node = node_of(spec);
  if (!node.empty()) {
    if (const auto finding = examine_node(node, roots, who)) return {*finding};
  }
  const Probe answer = probe(spec, robot, times, interrupted);
  if (!answer.problem.empty()) return {cannot_open(spec, answer, roots)};
  return {about_link(spec, robot, answer, times, interrupted)};
}

Findings examine_port(const std::string& path, const Roots& roots, const Identity& who, const ProbeTimes& times,
                      const Interrupted& interrupted) {
  if (auto finding = examine_node(path, roots, who)) return {*finding};
  Findings findings;
  for (const DeviceSpec& spec : who_answers(path, times, interrupted)) {
    const bool camera = *spec.row->role == devices::Role::kCamera;
    findings.push_back({kNote, "answers", spec.where() + " answers",
                        fmt::format("fencepost doctor --{} {}", camera ? "camera" : "odometry", spec.text)});
  }
  if (findings.empty()) {
    findings.push_back({kFault, "silent", "nothing that is known answers at " + path + " as it is delivered",
                        "check power and wires (TX to RX); 'doctor --camera KIND:" + path +
                            "' tries every baud for what you know to be there"});
  }
  return findings;
}

}  // namespace fencepost::host::doctor
