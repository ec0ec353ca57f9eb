// An i2c-tiny-usb adapter made of software: the kernel makes an I2C bus of it.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "tests/guest/usbip_device.hpp"

namespace fencepost::guest {

/// One message of a transfer, as it goes over the bus.
struct I2cMessage {
  std::uint8_t address = 0;  ///< 7 bits
  bool reading = false;
  bool last = false;       ///< a stop follows
  std::size_t length = 0;  ///< in bytes
  Bytes out;
};

/// Requests: i2c-tiny-usb.c of the Linux kernel.
class I2cAdapter {
 public:
  /// The answer to a message, of its length if it reads; nothing: not acknowledged.
  using Bus = std::function<std::optional<Bytes>(const I2cMessage&)>;

  /// `bus` is called on the adapter's own thread.
  explicit I2cAdapter(Bus bus);
  I2cAdapter(const I2cAdapter&) = delete;
  I2cAdapter& operator=(const I2cAdapter&) = delete;

  /// Its node, once the kernel has made it; empty if it never does.
  static std::string path();
  UsbipDevice& wire() { return device_; }

 private:
  UsbModel model();
  std::optional<Bytes> request(const UsbSetup& setup, const Bytes& out);

  Bus bus_;
  bool acknowledged_ = true;
  UsbipDevice device_;
};

}  // namespace fencepost::guest
