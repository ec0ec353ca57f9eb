#include <fmt/format.h>

#include <utility>

#include "host/geometry/planar.hpp"
#include "host/geometry/rings.hpp"
#include "host/scene/read_scene.hpp"

namespace fencepost::host {

namespace {

/// Maximum corners of one footprint: where two outlines cross, every edge may cross every other one.
constexpr std::size_t kMaxCorners = 500;

LinearRing read_ring(const JsonNode& node) {
  LinearRing ring;
  const std::size_t count = node.size(3, "corners");
  if (count > kMaxCorners + 1) {
    node.fail("has " + std::to_string(count) + " corners, at most " + std::to_string(kMaxCorners) + " are taken",
              "leave out corners that make no difference of a millimetre, or divide the object");
  }
  for (std::size_t i = 0; i < count; ++i) ring.push_back(node.at(i).point());
  ring = opened(std::move(ring));
  if (ring.size() < 3) node.fail("has fewer than three different corners", "give at least three");
  return ring;
}

Polygon read_circle(const JsonNode& node) {
  node.expect_keys({"circle"});
  const JsonNode circle = node.at("circle");
  if (circle.size(3, "numbers") > 3) circle.fail("has more than three numbers", "give [x, y, radius] in metres");
  const Point center{circle.at(std::size_t{0}).number(-kWorldLimit, kWorldLimit, "m"),
                     circle.at(std::size_t{1}).number(-kWorldLimit, kWorldLimit, "m")};
  const double radius = circle.at(std::size_t{2}).positive(kWorldLimit, "m");
  return {circle_ring(center, radius), {}};
}

void check_validity(const JsonNode& node, const Polygon& polygon) {
  const auto invalid = find_invalidity(polygon);
  if (!invalid) return;
  const std::string place = fmt::format("({:g}, {:g})", invalid->where.x, invalid->where.y);
  if (invalid->reason == "Self-intersection" || invalid->reason == "Ring Self-intersection") {
    node.fail("the outline crosses or touches itself at " + place,
              "list the corners in order around the object, each once");
  }
  if (invalid->reason == "Too few points") {
    node.fail("the outline has fewer than three different corners", "give at least three, as [x, y] in metres");
  }
  if (invalid->reason == "No area") node.fail("the outline encloses no area", "check the corners' coordinates");
  node.fail(invalid->reason + " at " + place, "check the corners' coordinates");
}

}  // namespace

LinearRing read_outline(const JsonNode& node) {
  LinearRing ring = read_ring(node);
  check_validity(node, {ring, {}});
  return ring;
}

Polygon read_footprint(const JsonNode& node) {
  if (node.has("circle")) return read_circle(node);
  node.expect_keys({"type", "coordinates"});
  const JsonNode type = node.at("type");
  if (type.text() != "Polygon") {
    type.fail("\"" + type.text() + "\" is not supported",
              "write a Polygon or {\"circle\": [x, y, r]}; one object for each part of a MultiPolygon");
  }
  const JsonNode rings = node.at("coordinates");
  const std::size_t count = rings.size(1, "rings");
  Polygon polygon;
  polygon.outer = read_ring(rings.at(std::size_t{0}));
  std::size_t corners = polygon.outer.size();
  for (std::size_t i = 1; i < count; ++i) {
    polygon.holes.push_back(read_ring(rings.at(i)));
    corners += polygon.holes.back().size();
    if (corners <= kMaxCorners) continue;
    rings.fail("have more than " + std::to_string(kMaxCorners) + " corners together",
               "leave out corners that make no difference of a millimetre, or divide the object");
  }
  check_validity(node, polygon);
  return oriented(std::move(polygon));
}

SceneObject read_object(const JsonNode& node, std::size_t index) {
  node.expect_keys({"name", "signature", "base", "height", "footprint", "path", "from", "until", "trained"});
  SceneObject object;
  const auto name = node.find("name");
  object.name = name ? name->text() : "object " + std::to_string(index + 1);
  if (const auto trained = node.find("trained")) object.trained = trained->truth();
  if (object.trained) {
    object.signature = static_cast<std::uint8_t>(node.at("signature").integer(0, 255));
  } else if (const auto signature = node.find("signature")) {
    signature->fail("what is not trained has no signature", "remove it, or \"trained\": false");
  }
  object.base = node.number_or("base", 0, 0, 100, "m");
  object.height_m = node.at("height").positive(100, "m");
  object.footprint = read_footprint(node.at("footprint"));
  if (const auto path = node.find("path")) object.path = read_object_path(*path);
  if (const auto from = node.find("from")) object.from = from->number(0, kLongestRun, "s");
  if (const auto until = node.find("until")) object.until = until->positive(kLongestRun, "s");
  if (object.from && object.until && *object.until <= *object.from) {
    node.at("until").fail("it is gone before it is there", "give a time after \"from\"");
  }
  return object;
}

}  // namespace fencepost::host
