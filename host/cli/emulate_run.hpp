// `fencepost emulate`: from a request to devices that run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {

struct EmulateRequest {
  std::vector<std::string> words;  ///< devices, and last the scene or log
  std::vector<std::string> links;  ///< of the devices without a place, in their order
  std::vector<std::string> listens;
  std::vector<std::string> faults;  ///< [DEVICE:]FAULT=...
  std::optional<std::uint32_t> baud;
  std::string camera;
  std::uint64_t seed = 1;
  double speed = 1;
  std::optional<double> delay;
  std::optional<double> seconds;
  bool loop = false;
  bool verbose = false;
};

/// errors: Failure: kUsage (devices, faults), kUnreadable (scene, log), kDevice (pty, link, port, CAN interface)
Exit emulate(const EmulateRequest& request);

}  // namespace fencepost::host::cli
