// The realistic paths of the reference: what a robot sees that does not drive around its objects.
#pragma once

#include <array>
#include <string_view>

#include "host/scene/scene.hpp"

namespace fencepost::test {

/// In the order of kPaths.
enum class Path { kApproach, kWinding, kPastSideways, kPastAslant, kTour };

struct PathText {
  Path path;
  std::string_view key;  ///< on the command line
  std::string_view name;
};
inline constexpr std::array<PathText, 5> kPaths = {{
    {Path::kApproach, "approach", "straight approach, 2.7 to 0.55 m"},
    {Path::kWinding, "winding", "S-curve approach, 0.3 m to each side"},
    {Path::kPastSideways, "past90", "drive past at 0.9 m, camera 90 degrees to the left"},
    {Path::kPastAslant, "past45", "drive past at 0.9 m, camera 45 degrees to the left"},
    {Path::kTour, "tour", "two sides of a square, camera 90 degrees to the left"},
}};

inline constexpr int kPathViews = 60;

/// The objects of reference_scene(), seen kPathViews times along a path. Distances are to the middle of their disc.
/// No noise.
host::Scene path_scene(Path path, unsigned seed);

}  // namespace fencepost::test
