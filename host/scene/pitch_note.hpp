// A warning about a camera's pitch, for users who trust the map.
#pragma once

#include <optional>
#include <string>

#include "hal/sensor/camera.hpp"

namespace fencepost::host {

/// Up to this pitch, rad (3 degrees), outlines are as good as those of a level camera: the table in
/// share/doc/frames.md.
inline constexpr double kHarmlessPitch = 0.0524;

/// A sentence about a pitch that is unknown or greater than kHarmlessPitch either way; empty where the pitch does no
/// harm.
std::optional<std::string> pitch_note(const sensor::CameraMount& mount);

}  // namespace fencepost::host
