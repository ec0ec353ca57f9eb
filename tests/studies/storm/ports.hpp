// Ports in memory, in place of those that host/live/open_port.hpp opens. ports.cpp defines its functions anew, so that
// the catalogue's own rows open their drivers on them.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "hal/bus/can_bus.hpp"
#include "host/live/device.hpp"
#include "host/live/robot_file.hpp"
#include "tests/studies/storm/far_end.hpp"

namespace fencepost::test {

/// The plugged-in devices, by the names of places. While one is alive, this thread opens its ports in it.
class Sockets {
 public:
  Sockets();
  ~Sockets();
  Sockets(const Sockets&) = delete;
  Sockets& operator=(const Sockets&) = delete;

  void plug_in(const std::string& place, FarEnd& device) { devices_[place] = &device; }
  /// The device at a place of the thread's latest Sockets. Throws host::DeviceFailure where nothing is.
  static FarEnd& at(const std::string& place);

 private:
  std::map<std::string, FarEnd*> devices_;
};

/// The catalogue opens a socket of the kernel by itself: the same driver on the cable of `place`.
std::unique_ptr<host::OdometryDevice> open_can_wheels(const std::string& place, const can_wheels::Mapping& mapping);

}  // namespace fencepost::test
