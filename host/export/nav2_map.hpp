// A run as a map for nav2's map_server: an image of free, occupied and unknown cells, and the YAML file that places it.
#pragma once

#include <optional>
#include <string>

#include "host/export/run.hpp"

namespace fencepost::host::exports {

struct Nav2Map {
  std::string yaml;
  std::string pgm;
  std::size_t occupied = 0;  ///< cells
  std::size_t free = 0;
};

/// Occupied: each cell that an outline touches, and the guard's points. Free: the places of the robot's body. All else
/// is unknown. `image`: the PGM's name for the YAML file. Nothing: more than kMaxCells.
std::optional<Nav2Map> nav2_map(const Run& run, const std::string& model, double resolution, const std::string& image);

inline constexpr double kMaxCells = 64e6;
inline constexpr double kMapResolution = 0.02;  ///< m a cell, a fifth of the smallest things

/// The zones of the robot's alerts as polygons of nav2's collision monitor, in the robot's frame.
std::string collision_monitor(const Run& run);

}  // namespace fencepost::host::exports
