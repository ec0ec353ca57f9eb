// Geometry of a model as GeoJSON.
#pragma once

#include <nlohmann/json.hpp>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// of lengths in m: a micrometre, far below any model's error, and short to read
inline constexpr int kLengthDecimals = 6;

/// Polygon or MultiPolygon; null when nothing with an area is left. Rings are closed and turned the GeoJSON way (outer
/// counter-clockwise, holes clockwise) whichever way they come.
nlohmann::ordered_json to_geojson(const MultiPolygon& geometry);

/// MultiLineString.
nlohmann::ordered_json lines_to_geojson(const std::vector<Polyline>& lines);

/// Nearest number with `decimals` decimals, never -0; null when not finite.
nlohmann::ordered_json rounded(double value, int decimals);

}  // namespace fencepost::host
