// The colours of one robot's world, for cameras that need them configured: a CMUcam's windows. Change them for yours.
#pragma once

#include <algorithm>
#include <array>

#include "drivers/cmucam/config.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::config {

/// Signature, then red, green, blue from..to, in 0..255. One window gets the camera's full rate, several share it.
inline constexpr std::array<cmucam::ColourWindow, 2> kColours = {{
    {1, 120, 255, 0, 70, 0, 70},  // red
    {2, 0, 70, 80, 255, 0, 90},   // green
}};
static_assert(kColours.size() <= cmucam::kMaxWindows);

/// To either side of a signature's colour, where nothing else is said.
inline constexpr int kHalfWindow = 40;
constexpr cmucam::ColourWindow window_around(const record::Signature& signature) {
  const auto from = [](std::uint8_t value) { return static_cast<std::uint8_t>(std::max(value - kHalfWindow, 0)); };
  const auto to = [](std::uint8_t value) { return static_cast<std::uint8_t>(std::min(value + kHalfWindow, 255)); };
  const sensor::Rgb rgb = signature.rgb;
  return {signature.signature, from(rgb.red),  to(rgb.red), from(rgb.green),
          to(rgb.green),       from(rgb.blue), to(rgb.blue)};
}

}  // namespace fencepost::config
