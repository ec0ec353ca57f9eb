#include "host/export/geojson_map.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/export/alert_place.hpp"
#include "host/geometry/rings.hpp"
#include "host/report/palette.hpp"
#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMetreDecimals = 4;
constexpr int kDegreeDecimals = 9;  ///< a tenth of a millimetre
constexpr double kRadians = std::numbers::pi / 180;

/// From metres of the map to the file's coordinates.
class Projection {
 public:
  explicit Projection(const std::optional<Anchor>& anchor) : anchor_(anchor) {
    if (!anchor) return;
    // Radii of curvature at the anchor.
    constexpr double kSemiMajor = 6'378'137;           // m, WGS 84
    constexpr double kFlattening = 1 / 298.257223563;  // WGS 84
    constexpr double kSquare = kFlattening * (2 - kFlattening);
    const double s = std::sin(anchor->latitude * kRadians);
    const double w = std::sqrt(1 - kSquare * s * s);
    degree_north_ = kSemiMajor * (1 - kSquare) / (w * w * w) * kRadians;
    degree_east_ = kSemiMajor / w * std::cos(anchor->latitude * kRadians) * kRadians;
  }

  [[nodiscard]] Json operator()(Point p) const {
    if (!anchor_) return Json::array({rounded(p.x, kMetreDecimals), rounded(p.y, kMetreDecimals)});
    const double c = std::cos(anchor_->bearing * kRadians);
    const double s = std::sin(anchor_->bearing * kRadians);
    const double east = s * p.x - c * p.y;
    const double north = c * p.x + s * p.y;
    return Json::array({rounded(anchor_->longitude + east / degree_east_, kDegreeDecimals),
                        rounded(anchor_->latitude + north / degree_north_, kDegreeDecimals)});
  }
  [[nodiscard]] Json ring(const LinearRing& ring) const {
    Json points = Json::array();
    for (const Point& p : ring) {
      Json point = (*this)(p);
      // Corners closer than a tenth of a millimetre, which strict readers refuse.
      if (points.empty() || points.back() != point) points.push_back(std::move(point));
    }
    while (points.size() > 1 && points.back() == points.front()) points.erase(points.size() - 1);
    points.push_back(points.front());
    return points;
  }
  [[nodiscard]] Json areas(const MultiPolygon& areas) const {
    Json polygons = Json::array();
    for (const Polygon& polygon : areas) {
      const Polygon turned = oriented(polygon);
      Json rings = Json::array({ring(turned.outer)});
      for (const LinearRing& hole : turned.holes) rings.push_back(ring(hole));
      polygons.push_back(std::move(rings));
    }
    if (polygons.size() == 1) return {{"type", "Polygon"}, {"coordinates", polygons.front()}};
    return {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}};
  }
  [[nodiscard]] Json point(Point p) const { return {{"type", "Point"}, {"coordinates", (*this)(p)}}; }

 private:
  std::optional<Anchor> anchor_;
  double degree_north_ = 1;  ///< m
  double degree_east_ = 1;
};

Json feature(Json geometry, Json properties) {
  return {{"type", "Feature"}, {"properties", std::move(properties)}, {"geometry", std::move(geometry)}};
}

void add_objects(Json& features, const Run& run, const std::string& model, const Projection& project) {
  for (const ObjectResult& object : run.document.objects) {
    const ModelResult* outline = outline_of(object, model);
    if (outline == nullptr) continue;
    const std::string colour = hex(signature_colour(run.document, object.signature));
    features.push_back(
        feature(project.areas(outline->geometry), {{"kind", "object"},
                                                   {"id", object.id},
                                                   {"name", signature_name(run.document, object.signature)},
                                                   {"state", record::name(object.state)},
                                                   {"model", outline->name},
                                                   {"views", object.views},
                                                   {"confidence", rounded(object.confidence, 2)},
                                                   {"z_min", rounded(object.z_min, kMetreDecimals)},
                                                   {"z_max", rounded(object.z_max, kMetreDecimals)},
                                                   // geojson.io and others draw with these.
                                                   {"fill", colour},
                                                   {"stroke", colour}}));
  }
}

void add_path(Json& features, const Run& run, const Projection& project) {
  constexpr double kFinest = 0.005;  // m
  const std::vector<PoseResult>& path = run.document.path;
  Json points = Json::array();
  const PoseResult* last = nullptr;
  for (const PoseResult& pose : path) {
    const bool end = &pose == &path.back() && points.size() == 1;  // a line has two points
    if (last != nullptr && !end && std::hypot(pose.x - last->x, pose.y - last->y) < kFinest) continue;
    points.push_back(project({pose.x, pose.y}));
    last = &pose;
  }
  if (points.size() < 2) return;
  features.push_back(feature({{"type", "LineString"}, {"coordinates", std::move(points)}},
                             {{"kind", "path"},
                              {"from", rounded(path.front().t, kMetreDecimals)},
                              {"to", rounded(path.back().t, kMetreDecimals)}}));
}

void add_alerts(Json& features, const Run& run, const Projection& project) {
  for (const record::AlertReport& alert : run.document.alerts) {
    const std::optional<Point> at = place_of(run.document, alert);
    if (!at) continue;
    features.push_back(feature(project.point(*at), {{"kind", "alert"},
                                                    {"t", rounded(alert.t.to_double(), kMetreDecimals)},
                                                    {"level", record::name(alert.level)},
                                                    {"id", alert.id},
                                                    {"name", signature_name(run.document, alert.signature)}}));
  }
}

}  // namespace

std::string geojson_of(const Run& run, const std::string& model, const std::optional<Anchor>& anchor) {
  const Projection project(anchor);
  Json features = Json::array();
  add_objects(features, run, model, project);
  add_path(features, run, project);
  add_alerts(features, run, project);
  for (const GuardPoint& point : run.document.guard) {
    features.push_back(feature(project.point({point.x, point.y}),
                               {{"kind", "guard"}, {"name", signature_name(run.document, point.signature)}}));
  }
  Json json = {{"type", "FeatureCollection"}};
  if (!anchor) json["coordinates_in"] = "metres of the map frame: x forward at the start, y left";
  json["features"] = std::move(features);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace fencepost::host::exports
