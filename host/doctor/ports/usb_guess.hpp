// Guesses a USB device's kind and name by its ids.
#pragma once

#include <string>
#include <vector>

#include "host/devices/row.hpp"
#include "host/doctor/ports/port_list.hpp"

namespace fencepost::host::doctor {

enum class UsbKind : std::uint8_t {
  kDevice,   ///< a camera or wheels of the catalogue, by ids of its own
  kBoard,    ///< a board that can be a robot: its console
  kAdapter,  ///< a serial adapter: anything may be behind it
  kUnknown,
};

struct UsbGuess {
  UsbKind kind = UsbKind::kUnknown;
  std::string name;      ///< "CP210x serial adapter"; empty of an unknown one
  std::string try_next;  ///< a command line, without "fencepost"
};

/// `path`: of its port.
UsbGuess guess_usb(const UsbDevice& device, const std::string& path);

/// The rows of the catalogue with these ids.
std::vector<const devices::Row*> rows_of(const UsbDevice& device);

}  // namespace fencepost::host::doctor
