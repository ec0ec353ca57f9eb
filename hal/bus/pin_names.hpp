// Names of the pins of a board's ports as its header has them, for people.
#pragma once

#include <string_view>

namespace fencepost::bus {

/// Empty: the board has no such port, or does not say.
struct PinNames {
  std::string_view line;      ///< a camera's: sends, receives
  std::string_view base;      ///< a wheel base's: sends, receives
  std::string_view two_wire;  ///< data, clock
  std::string_view encoders;  ///< left A and B, right A and B
};

}  // namespace fencepost::bus
