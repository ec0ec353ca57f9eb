// The data that a driver may need when it is opened.
#pragma once

#include <span>

#include "firmware/config/devices.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::image {

/// All borrowed; counters for as long as the driver is open.
struct Opening {
  const config::Devices& devices;
  const console::Counters& counters;
  std::span<const record::Signature> signatures;

  [[nodiscard]] std::uint32_t camera_baud() const { return info(devices.camera()).speed; }
  [[nodiscard]] std::uint8_t camera_address() const { return info(devices.camera()).address; }
  [[nodiscard]] std::uint32_t base_baud() const { return info(devices.odometry()).speed; }
};

}  // namespace fencepost::image
