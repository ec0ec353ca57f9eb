// Colours as files and options have them: six hex digits RRGGBB.
#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

inline std::string rgb_text(sensor::Rgb rgb) { return fmt::format("{:02x}{:02x}{:02x}", rgb.red, rgb.green, rgb.blue); }

inline std::optional<sensor::Rgb> rgb_of(std::string_view digits) {
  if (digits.size() != 6 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos) {
    return std::nullopt;
  }
  const unsigned long rgb = std::stoul(std::string(digits), nullptr, 16);
  const auto channel = [&](unsigned shift) { return static_cast<std::uint8_t>(rgb >> shift & 0xFFU); };
  return sensor::Rgb{channel(16), channel(8), channel(0)};
}

}  // namespace fencepost::host
