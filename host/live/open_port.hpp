// Opens the ports that device names and console names speak of.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/live/device_spec.hpp"
#include "host/live/port.hpp"

namespace fencepost::host {

/// Why a port or device cannot be used. Thrown within host/live.
struct DeviceFailure {
  bool usage = false;  ///< what was asked for makes no sense, whatever is plugged in
  std::string message;
};

/// The port if it opens, or one that is awaited. errors: DeviceFailure, where it must be there and is not.
template <class AnyPort>
std::unique_ptr<AnyPort> opened(std::unique_ptr<AnyPort> port, const std::string& what, bool wait) {
  if (!port->try_open() && !wait) throw DeviceFailure{false, what + ": " + port->problem()};
  return port;
}

/// A tty or tcp place. `what` begins the message. errors: DeviceFailure
std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t baud, const std::string& what, bool wait);

/// The same, an SPI device, or the pipe of a Pixy2 on USB. errors: DeviceFailure
std::unique_ptr<BytePort> open_byte_port(const DeviceSpec& spec, std::uint32_t baud, bool wait);

std::unique_ptr<I2cPort> open_i2c_port(const DeviceSpec& spec, bool wait);

/// An NXT brick on USB; over Bluetooth the telegrams go through drivers/nxt/framed_link.hpp.
std::unique_ptr<PacketPort> open_brick_port(const DeviceSpec& spec, bool wait);

}  // namespace fencepost::host
