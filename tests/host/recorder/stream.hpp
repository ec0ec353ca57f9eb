// Lines of a robot's stream.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "hal/base/crc16.hpp"

namespace fencepost::host::testing {

/// `fields` without '$' and '*', as a whole line with its CRC.
inline std::string line_of(std::string_view fields) {
  return fmt::format("${}*{:04X}\r\n", fields, base::crc16(fields));
}

inline std::string frame_line(double t, unsigned frame) { return line_of(fmt::format("FPFRM,{:.4f},{},0", t, frame)); }

}  // namespace fencepost::host::testing
