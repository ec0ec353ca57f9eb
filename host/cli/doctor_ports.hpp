// `fencepost doctor` on ports: what is there, and how a device is.
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

/// A device's node, or what would be one, rather than a log.
bool names_port(const std::string& subject);

/// `port`: ask who is there; empty: list them all, or ask the devices that the options name. errors: Failure
PortExamination examine_ports(const std::string& port, const PortRequestOptions& options);

}  // namespace fencepost::host::cli
