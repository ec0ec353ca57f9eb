// Outlines as solids: extruded from the floor up.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "host/geometry/polygon.hpp"
#include "host/result/result.hpp"

namespace fencepost::host::exports {

/// Triangles, counter-clockwise seen from outside; each face has corners of its own, so that edges stay sharp.
struct Mesh {
  std::vector<std::array<float, 3>> points;   ///< m, map frame, z up
  std::vector<std::array<float, 3>> normals;  ///< of length 1, one a point
  std::vector<std::uint32_t> indices;         ///< three a triangle
};

Mesh extruded(const MultiPolygon& areas, double low, double high);

/// The heights between which an object reaches, m. Unknown heights, and those of less than a centimetre, count as a
/// centimetre.
struct Band {
  double low = 0;
  double high = 0;
};
Band band_of(const ObjectResult& object);

}  // namespace fencepost::host::exports
