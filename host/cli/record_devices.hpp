// `fencepost record` of a camera and wheels of this machine: `fencepost run` without a console.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal/base/units.hpp"
#include "host/cli/exit_code.hpp"

namespace fencepost::host::cli {

struct DeviceRecording {
  std::string camera;    ///< as `run` takes it
  std::string odometry;  ///< as `run` takes it
  std::string robot;     ///< a file, or empty
  std::string colours;   ///< likewise
  std::string log;
  std::uint64_t part_bytes = 0;  ///< 0: no limit
  base::Duration part_age{};     ///< 0: no limit
  bool wait = false;
  std::optional<double> seconds;
};

/// Until a signal, the time is over, or the file cannot be written. errors: Failure
Exit record_devices(const DeviceRecording& recording);

}  // namespace fencepost::host::cli
