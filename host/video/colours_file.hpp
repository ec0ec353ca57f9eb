// Trained colours as a file that `--colours` takes, and what is wrong with one.
#pragma once

#include <span>
#include <string>

#include "host/video/colour_training.hpp"

namespace fencepost::host {

struct NamedColour {
  TrainedColour trained;
  std::string name;  ///< at most sensor::kMaxText characters
};

/// A part of a robot file (host/share/doc/live.md): its "signatures" and its "colours".
std::string colours_file(std::span<const NamedColour> colours);

/// Less of its boxes has its colour than there is of a thing in good light.
bool is_patchy(const TrainedColour& colour);
/// As much of the picture looks the same elsewhere as a blob needs.
bool is_elsewhere(const TrainedColour& colour, int width, int height);

}  // namespace fencepost::host
