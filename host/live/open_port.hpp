// Opens the ports that device names and console names speak of.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/live/place.hpp"
#include "host/live/port.hpp"

namespace fencepost::host {

/// Why a port or device cannot be used. Thrown by what opens them.
struct DeviceFailure {
  bool usage = false;  ///< the request is invalid, whatever is plugged in
  std::string message;
};

/// For whom a port is opened, and how.
struct PortRequest {
  std::string what;   ///< begins the message of a failure
  bool wait = false;  ///< a port that is not there is awaited, instead of a failure
};

/// The port if it opens, or one that is awaited. errors: DeviceFailure, where it must be there and is not.
template <class AnyPort>
std::unique_ptr<AnyPort> opened(std::unique_ptr<AnyPort> port, const PortRequest& request) {
  if (!port->try_open() && !request.wait) throw DeviceFailure{false, request.what + ": " + port->problem()};
  return port;
}

/// A tty or tcp place. errors, of all that follow: DeviceFailure
std::unique_ptr<BytePort> open_line(const Place& place, std::uint32_t baud, const PortRequest& request);

/// `hertz`: of the clock.
std::unique_ptr<BytePort> open_spi(const std::string& path, std::uint32_t hertz, const PortRequest& request);

/// The pipe of a Pixy2 on USB. `serial`: of the one that is meant; empty: any.
std::unique_ptr<BytePort> open_pixy_pipe(const std::string& serial, const PortRequest& request);

std::unique_ptr<I2cPort> open_i2c(const std::string& path, const PortRequest& request);

/// An NXT brick on USB; over Bluetooth the telegrams go through drivers/nxt/framed_link.hpp.
std::unique_ptr<PacketPort> open_brick_port(const std::string& serial, const PortRequest& request);

}  // namespace fencepost::host
