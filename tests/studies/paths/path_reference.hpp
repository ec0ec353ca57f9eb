// Our prototype's figures on these paths: R + P, points of per cent, 40 scenes, flags given.
#pragma once

#include <array>

#include "tests/studies/paths/path_scene.hpp"

namespace fencepost::test {

struct PathReference {
  Path path;
  bool drift;
  double cylinder;
  double sheaf;
  double carving;
  double hybrid;
  double hybrid_with_rows;
  double standard_error;  ///< of the last, scenes as units
};

inline constexpr std::array<PathReference, 10> kPathReferences = {{
    {Path::kApproach, false, 151.4, 176.7, 150.8, 93.8, 67.0, 2.5},
    {Path::kWinding, false, 85.1, 125.8, 135.6, 59.1, 48.6, 1.9},
    {Path::kPastSideways, false, 91.8, 121.5, 86.3, 55.6, 46.8, 1.9},
    {Path::kPastAslant, false, 81.4, 99.7, 103.9, 53.7, 47.6, 1.9},
    {Path::kTour, false, 44.7, 69.6, 53.6, 28.9, 28.3, 1.3},
    {Path::kApproach, true, 187.9, 181.3, 159.9, 154.2, 118.7, 5.7},
    {Path::kWinding, true, 136.4, 125.2, 151.1, 116.8, 108.3, 6.7},
    {Path::kPastSideways, true, 112.4, 131.9, 107.3, 83.1, 78.8, 4.8},
    {Path::kPastAslant, true, 118.9, 114.2, 124.5, 100.9, 91.3, 6.0},
    {Path::kTour, true, 73.2, 79.0, 79.3, 64.3, 64.3, 4.2},
}};

}  // namespace fencepost::test
