// `fencepost doctor` on ports: the list of ports, and a device's state.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "host/cli/exit_code.hpp"
#include "host/cli/options.hpp"

namespace fencepost::host::cli {

struct PortRequestOptions {
  std::string camera;
  std::string odometry;
  std::string robot;
  std::string colours;

  void add_to(Options command);
  [[nodiscard]] bool names_devices() const { return !camera.empty() || !odometry.empty(); }
};

struct PortExamination {
  std::string text;
  nlohmann::ordered_json document;
  Exit exit = Exit::kDone;
};

/// A path of a device, even if none is there, rather than of a log.
bool names_port(const std::string& subject);

/// `port`: ask who is there; empty: list them all, or ask the devices that the options name. errors: Failure
PortExamination examine_ports(const std::string& port, const PortRequestOptions& options);

}  // namespace fencepost::host::cli
