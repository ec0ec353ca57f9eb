// An NXT brick as USB describes it.
#pragma once

#include "tests/guest/usbip_device.hpp"

namespace fencepost::guest {

inline constexpr std::uint8_t kNxtOut = 0x01;
inline constexpr std::uint8_t kNxtIn = 0x82;

/// A device of one interface with two bulk endpoints of 64 bytes; LEGO MINDSTORMS NXT BDK, appendix 1.
inline UsbModel nxt_model() {
  UsbModel model;
  model.vendor = 0x0694;
  model.product = 0x0002;
  model.strings = {"LEGO Group", "NXT", "0016530A1B2C"};
  model.interface_descriptors = {9, 4, 0,       0, 2,  0xFF, 0xFF, 0xFF, 0,  // interface 0
                                 7, 5, kNxtOut, 2, 64, 0,    0,              // bulk
                                 7, 5, kNxtIn,  2, 64, 0,    0};
  return model;
}

}  // namespace fencepost::guest
