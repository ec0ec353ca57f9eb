// The colours of one robot's world, for cameras that are told them: a CMUcam's windows. Change them for yours.
#pragma once

#include <array>

#include "drivers/cmucam/config.hpp"

namespace fencepost::config {

/// Signature, then red, green, blue from..to, in 0..255. One window gets the camera's full rate, several share it.
inline constexpr std::array<cmucam::ColourWindow, 2> kColours = {{
    {1, 120, 255, 0, 70, 0, 70},  // red
    {2, 0, 70, 80, 255, 0, 90},   // green
}};
static_assert(kColours.size() <= cmucam::kMaxWindows);

}  // namespace fencepost::config
