#include "host/result/geojson.hpp"

#include <algorithm>
#include <cmath>

#include "host/geometry/rings.hpp"

namespace fencepost::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kSmallestRing = 3;

Json points_json(const std::vector<Point>& line) {
  Json points = Json::array();
  for (const Point& p : line) {
    points.push_back(Json::array({rounded(p.x, kLengthDecimals), rounded(p.y, kLengthDecimals)}));
  }
  return points;
}

Json ring_json(LinearRing ring, bool counter_clockwise) {
  if ((signed_area(ring) > 0) != counter_clockwise) std::reverse(ring.begin(), ring.end());
  Json points = points_json(ring);
  points.push_back(points.front());
  return points;
}

Json polygon_json(const Polygon& polygon) {
  Json rings = Json::array({ring_json(polygon.outer, true)});
  for (const LinearRing& hole : polygon.holes) {
    if (hole.size() >= kSmallestRing) rings.push_back(ring_json(hole, false));
  }
  return rings;
}

}  // namespace

Json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;  // + 0.0 turns -0 into 0
}

Json to_geojson(const MultiPolygon& geometry) {
  Json polygons = Json::array();
  for (const Polygon& polygon : geometry) {
    if (polygon.outer.size() >= kSmallestRing) polygons.push_back(polygon_json(polygon));
  }
  if (polygons.empty()) return nullptr;
  if (polygons.size() == 1) return {{"type", "Polygon"}, {"coordinates", polygons.front()}};
  return {{"type", "MultiPolygon"}, {"coordinates", polygons}};
}

Json lines_to_geojson(const std::vector<Polyline>& lines) {
  Json all = Json::array();
  for (const Polyline& line : lines) all.push_back(points_json(line));
  return {{"type", "MultiLineString"}, {"coordinates", std::move(all)}};
}

}  // namespace fencepost::host
