#include "host/cli/live_devices.hpp"

#include <algorithm>

#include "host/cli/exit_code.hpp"
#include "host/cli/files.hpp"
#include "host/cli/log_size.hpp"
#include "host/devices/open_devices.hpp"
#include "host/live/open_port.hpp"
#include "host/recorder/standard_input.hpp"

namespace fencepost::host::cli {

devices::DeviceSpec device_of(const std::string& text, devices::Use use) {
  const auto spec = devices::parse_device(text, use);
  if (!spec.ok()) throw Failure(Exit::kUsage, spec.error());
  return *spec;
}

namespace {

RobotFile parsed(const std::string& path) {
  const auto robot = parse_robot(read_input(path), input_name(path));
  if (!robot.ok()) throw Failure(Exit::kUnreadable, robot.error());
  return *robot;
}

}  // namespace

RobotFile read_robot(const std::string& path, const std::string& colours) {
  RobotFile robot = path.empty() ? RobotFile() : parsed(path);
  if (colours.empty()) return robot;
  const RobotFile trained = parsed(colours);
  if (trained.colours.empty()) {
    throw Failure(Exit::kUnreadable,
                  input_name(colours) + ": has no \"colours\"; 'fencepost train' writes such a file");
  }
  robot.colours = trained.colours;
  for (const record::Signature& signature : trained.signatures) {
    const auto same = [&](const record::Signature& own) { return own.signature == signature.signature; };
    if (std::none_of(robot.signatures.begin(), robot.signatures.end(), same)) robot.signatures.push_back(signature);
  }
  return robot;
}

void add_colours(Options command, std::string& colours) {
  command.value("--colours,--colors", colours, "what a v4l2 or video camera looks for: a file of fencepost train")
      .takes("FILE");
}

Devices open_devices_of(const DevicePair& named, const RobotFile& robot, linux::MonotonicClock clock, bool wait) {
  auto opened = devices::open_devices(named.camera, named.odometry, robot, clock, wait);
  if (const auto* failure = std::get_if<DeviceFailure>(&opened)) {
    const std::string hint = failure->usage ? "" : ", or --wait for it";
    throw Failure(failure->usage ? Exit::kUsage : Exit::kDevice, failure->message + hint);
  }
  return std::move(*std::get_if<Devices>(&opened));
}

std::unique_ptr<BytePort> open_console(const std::string& port, std::uint32_t baud, bool wait) {
  if (port == "-") return std::make_unique<StandardInput>();
  Place place{PlaceKind::kTty, port};
  if (port.starts_with("tcp:")) {
    const std::optional<Place> tcp = parse_tcp(port);
    if (!tcp) throw Failure(Exit::kUsage, "'" + port + "' is no place; write tcp:HOST:PORT");
    place = *tcp;
  }
  try {
    return open_line(place, baud, {"PORT", wait});
  } catch (const DeviceFailure& failure) {
    throw Failure(failure.usage ? Exit::kUsage : Exit::kDevice, failure.message);
  }
}

void PartOptions::add_to(Options command) {
  command.value("--log-size", size, "begin a new part of the log after so much, such as 64M").takes("SIZE");
  command.value("--log-minutes", minutes, "begin a new part of the log after so long").takes("N").positive();
}

std::uint64_t PartOptions::bytes() const {
  if (size.empty()) return 0;
  constexpr std::uint64_t kMin = 4096;  // a part begins with a kilobyte of calibration
  const auto bytes = size_in(size);
  if (bytes && *bytes >= kMin) return *bytes;
  throw Failure(Exit::kUsage, "--log-size " + size + " is not possible; write 4K, 64M or 2G");
}

base::Duration PartOptions::age() const { return minutes ? base::Duration::nearest(60 * *minutes) : base::Duration{}; }

}  // namespace fencepost::host::cli
