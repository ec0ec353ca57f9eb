#include "host/scene/pitch_note.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace fencepost::host {

std::optional<std::string> pitch_note(const sensor::CameraMount& mount) {
  if (!mount.pitch) {
    return "camera pitch unknown: the camera is taken to be level and rows give no distances; if it looks more than 3 "
           "degrees up or down, outlines are too coarse: measure the pitch (share/doc/frames.md)";
  }
  const double pitch = mount.pitch->to_double();
  if (std::abs(pitch) <= kHarmlessPitch) return std::nullopt;
  return fmt::format(
      "camera pitch {:.1f} degrees {}: beyond 3 degrees outlines get coarser, and a wrong pitch misplaces objects "
      "(share/doc/frames.md)",
      std::abs(pitch) * 180 / std::numbers::pi, pitch > 0 ? "down" : "up");
}

}  // namespace fencepost::host
