// A run as GeoJSON: outlines, path, alerts and what the guard knows, each a feature.
#pragma once

#include <optional>
#include <string>

#include "host/export/run.hpp"

namespace fencepost::host::exports {

/// Where the map's origin lies on the earth, and where its x axis points.
struct Anchor {
  double latitude = 0;   ///< deg, WGS 84
  double longitude = 0;  ///< deg
  double bearing = 90;   ///< deg, clockwise from north; 90: x is east, y north
};

/// A FeatureCollection. Without an anchor coordinates are metres of the map frame, as a member of it says. With one
/// they are longitude and latitude (RFC 7946), good to a millimetre within a kilometre of the anchor.
std::string geojson_of(const Run& run, const std::string& model, const std::optional<Anchor>& anchor);

}  // namespace fencepost::host::exports
