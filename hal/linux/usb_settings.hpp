// Which pipe of which USB device.
#pragma once

#include <cstdint>
#include <string>

#include "hal/base/units.hpp"

namespace fencepost::linux {

struct UsbSettings {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::string serial{};  ///< of the device wanted; empty: the first one
  std::uint8_t interface = 0;
  std::uint8_t out_endpoint = 0x01;  ///< bulk
  std::uint8_t in_endpoint = 0x81;   ///< bulk, with the direction bit
  /// A reset of the device on opening, for firmware that otherwise goes on where the last program left it.
  bool reset = false;
  /// How long libusb or the kernel may take for opening, returning transfers or closing before the thread is abandoned.
  /// They take milliseconds; the kernel itself allows a device that does not answer up to five seconds.
  base::Duration timeout = base::milliseconds(8'000);
};

/// LEGO NXT brick (LEGO Mindstorms NXT Communication Protocol, USB): one telegram a transfer, at most 64 bytes.
inline const UsbSettings kNxtUsb{.vendor = 0x0694, .product = 0x0002, .in_endpoint = 0x82};

/// Pixy and Pixy2 (libpixyusb, libpixyusb2, which reset it likewise); both have the same ids.
inline const UsbSettings kPixyUsb{
    .vendor = 0xB1AC, .product = 0xF000, .interface = 1, .out_endpoint = 0x02, .in_endpoint = 0x82, .reset = true};

}  // namespace fencepost::linux
