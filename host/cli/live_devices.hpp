// Shared by `run`, `record` and `monitor`: cameras, wheels and robots' consoles at this machine.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/cli/options.hpp"
#include "host/devices/device_spec.hpp"
#include "host/live/device.hpp"
#include "host/live/port.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host::cli {

struct DevicePair {
  devices::DeviceSpec camera;
  devices::DeviceSpec odometry;
};

/// errors: Failure (kUsage)
devices::DeviceSpec device_of(const std::string& text, devices::Use use);

/// Empty paths: no numbers. `colours`: a file of `fencepost train`; its colours replace the robot file's. A signature
/// that both name keeps the robot file's name and width. errors: Failure (kUnreadable)
RobotFile read_robot(const std::string& path, const std::string& colours = {});

/// The option that names it.
void add_colours(Options command, std::string& colours);

/// errors: Failure (kUsage, kDevice)
Devices open_devices_of(const DevicePair& named, const RobotFile& robot, linux::MonotonicClock clock, bool wait);

/// A robot's console: a serial port, tcp:HOST:PORT, or - for standard input. errors: Failure (kUsage, kDevice)
std::unique_ptr<BytePort> open_console(const std::string& port, std::uint32_t baud, bool wait);

/// --log-size and --log-minutes: when a log goes on in a new part.
struct PartOptions {
  std::string size;
  std::optional<double> minutes;

  void add_to(Options command);
  [[nodiscard]] bool given() const { return minutes || !size.empty(); }
  /// 0: no limit. errors: Failure (kUsage)
  [[nodiscard]] std::uint64_t bytes() const;
  [[nodiscard]] base::Duration age() const;
};

}  // namespace fencepost::host::cli
