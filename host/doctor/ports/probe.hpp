// Asks a device how it is, with the driver that `run` would use.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hal/sensor/link_state.hpp"
#include "host/devices/device_spec.hpp"
#include "host/doctor/finding.hpp"
#include "host/doctor/ports/surroundings.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host::doctor {

struct ProbeTimes {
  base::Duration answer = base::milliseconds(2'500);   ///< until a device that works has said something
  base::Duration measure = base::milliseconds(1'000);  ///< of its rate, after that
  base::Duration other_baud = base::milliseconds(1'200);
  bool settling = true;  ///< a camera that answers gets the time, too, in which it settles white balance and gain
};

/// True: stop and return the answers so far.
using Interrupted = std::function<bool()>;

struct Probe {
  sensor::LinkState link = sensor::LinkState::kAbsent;
  std::string problem;                      ///< of opening the port; then nothing was asked
  std::uint64_t items = 0;                  ///< frames or poses while it was measured
  double rate = 0;                          ///< a second
  std::uint64_t blobs = 0;                  ///< of those frames
  std::optional<std::uint32_t> answers_at;  ///< the baud at which it did, where that is not the one asked for
};

/// `spec` may be at any place but behind a brick. errors, thrown: host::DeviceFailure where the request is invalid
Probe probe(const devices::DeviceSpec& spec, const RobotFile& robot, const ProbeTimes& times,
            const Interrupted& interrupted);

/// The same at other speeds than the one of `spec`, until it answers at one.
std::optional<std::uint32_t> find_baud(const devices::DeviceSpec& spec, const RobotFile& robot, const ProbeTimes& times,
                                       const Interrupted& interrupted);

/// Every device of the catalogue that can be at a serial port, each as delivered: those that work, or
/// if none does those that answer.
std::vector<devices::DeviceSpec> who_answers(const std::string& path, const ProbeTimes& times,
                                             const Interrupted& interrupted);

/// Examines the device from its port up to its data. Exactly one finding about the device comes last: no_port,
/// no_permission, busy, cannot_open, wrong_baud, silent, unready, nothing_seen or fine.
Findings examine_device(const devices::DeviceSpec& spec, const RobotFile& robot, const Roots& roots,
                        const Identity& who, const ProbeTimes& times, const Interrupted& interrupted);

/// Examines a serial port whatever is behind it: no_port, no_permission, busy, silent, or an `answers` for each device
/// that it may be.
Findings examine_port(const std::string& path, const Roots& roots, const Identity& who, const ProbeTimes& times,
                      const Interrupted& interrupted);

/// Examines a path: no_port, no_permission, busy; nothing where it can be opened.
std::optional<Finding> examine_node(const std::string& path, const Roots& roots, const Identity& who);

}  // namespace fencepost::host::doctor
