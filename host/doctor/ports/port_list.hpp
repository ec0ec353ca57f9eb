// The ports of this machine to which a camera or wheels can be plugged, and what is plugged in by USB's ids.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/doctor/ports/surroundings.hpp"
#include "host/live/place.hpp"

namespace fencepost::host::doctor {

struct UsbDevice {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string maker;  ///< as the device says, like the next two; may be empty
  std::string name;
  std::string serial;
};

struct PortEntry {
  PlaceKind kind = PlaceKind::kTty;
  std::string path;     ///< of its node; of CAN the interface's name
  std::string lasting;  ///< a name that stays when others are plugged in, under serial/by-id; may be empty
  std::optional<UsbDevice> usb;
  std::string detail;  ///< the adapter's name, or a CAN interface's state
};

/// Serial ports that exist (not those that a kernel only could have), I2C and SPI buses, CAN interfaces. Also USB
/// devices without a port that a driver of ours uses.
std::vector<PortEntry> list_ports(const Roots& roots);

/// The USB device behind a serial port.
std::optional<UsbDevice> usb_of_tty(const Roots& roots, const std::string& path);

/// "10c4:ea60".
std::string usb_id(const UsbDevice& device);

}  // namespace fencepost::host::doctor
