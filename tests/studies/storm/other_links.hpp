// Cameras of the catalogue on links that host/emulate has no cable for: two-wire buses and USB.
#pragma once

#include <memory>
#include <string>

#include "host/emulate/models/device_model.hpp"
#include "host/emulate/models/i2c_device.hpp"

namespace fencepost::test {

/// Images come by the one, the bus by the other; it says nothing unasked.
class WiredModel : public emulate::DeviceModel, public emulate::I2cDevice {
 public:
  emulate::Bytes take(std::uint8_t /*byte*/, base::Time /*now*/) override { return {}; }
  [[nodiscard]] bool in_use() const override { return true; }
};

/// A row's camera, at the address that its driver asks. Throws std::runtime_error where there is no model of it.
std::unique_ptr<emulate::DeviceModel> on_two_wires(const std::string& row);

/// The same on USB, whose transfers are of this size.
inline constexpr std::size_t kUsbTransfer = 64;
std::unique_ptr<emulate::DeviceModel> on_usb(const std::string& row);

}  // namespace fencepost::test
