// Drivers on ports, as rows open them.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "drivers/wire/i2c_stream.hpp"
#include "host/devices/device_spec.hpp"
#include "host/live/device.hpp"
#include "host/live/open_port.hpp"

namespace fencepost::devices {

/// A polled camera gets its next request when its reply has arrived: then the loop iterates at once.
inline constexpr base::Duration kAsked = base::milliseconds(4);
/// Nothing wakes the loop: the device has to be polled.
inline constexpr base::Duration kLookedAt = base::milliseconds(2);
/// Wheels send unasked, and a silence is noticed in tenths of a second.
inline constexpr base::Duration kTalks = base::milliseconds(50);

inline constexpr double metres(std::int64_t picometres) { return static_cast<double>(picometres) * 1e-12; }

/// A driver and its port, for host::PortedDevice.
template <class Driver, class Port = host::BytePort>
struct Ported {
  template <class... Arguments>
  explicit Ported(std::unique_ptr<Port> opened, Arguments&&... arguments)
      : own_port(std::move(opened)), driver(*own_port, std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] host::Port& port() const { return *own_port; }

  std::unique_ptr<Port> own_port;
  Driver driver;
};

/// The same on an I2C bus, at an address.
using I2cLink = wire::I2cStream<host::I2cPort>;
template <class Driver>
struct OnI2c {
  template <class... Arguments>
  OnI2c(std::unique_ptr<host::I2cPort> port, std::uint8_t address, Arguments&&... arguments)
      : bus(std::move(port)), link(*bus, address), driver(link, std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] host::Port& port() const { return *bus; }

  std::unique_ptr<host::I2cPort> bus;
  I2cLink link;
  Driver driver;
};

template <class Driver, class... Arguments>
std::unique_ptr<host::CameraDevice> camera_on_i2c(const Opening& opening, Arguments&&... arguments) {
  const auto address = static_cast<std::uint8_t>(opening.spec.number("address"));
  return std::make_unique<host::PortedCamera<OnI2c<Driver>>>(kLookedAt,
                                                             host::open_i2c(opening.spec.place.name, opening.port()),
                                                             address, std::forward<Arguments>(arguments)...);
}

/// The port of a device at a tty or on tcp.
inline std::unique_ptr<host::BytePort> open_line(const Opening& opening) {
  return host::open_line(opening.spec.place, opening.spec.number("baud"), opening.port());
}

template <class Driver, class... Arguments>
std::unique_ptr<host::CameraDevice> camera_on_line(const Opening& opening, Arguments&&... arguments) {
  return std::make_unique<host::PortedCamera<Ported<Driver>>>(kAsked, open_line(opening),
                                                              std::forward<Arguments>(arguments)...);
}

template <class Driver, class... Arguments>
std::unique_ptr<host::OdometryDevice> odometry_on_line(const Opening& opening, Arguments&&... arguments) {
  return std::make_unique<host::PortedOdometry<Ported<Driver>>>(kTalks, open_line(opening),
                                                                std::forward<Arguments>(arguments)...);
}

}  // namespace fencepost::devices
