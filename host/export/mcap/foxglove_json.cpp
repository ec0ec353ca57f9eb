// Messages as JSON, by the names that Foxglove and Lichtblick draw; odometry and detections as ROS 2 names them.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "host/export/mcap/encoding.hpp"
#include "host/export/mcap/json_schemas.hpp"
#include "host/export/prism.hpp"
#include "host/result/geojson.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host::exports {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kDecimals = 4;          ///< of lengths and quaternions
constexpr double kLineWidth = 2;      ///< px
constexpr double kFontSize = 12;      ///< px
constexpr double kLabelAbove = 0.03;  ///< m

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json time(double t) {
  const Stamp stamp(t);
  return {{"sec", stamp.seconds}, {"nsec", stamp.nanoseconds}};
}
Json vector(double x, double y, double z) {
  return {{"x", rounded(x, kDecimals)}, {"y", rounded(y, kDecimals)}, {"z", rounded(z, kDecimals)}};
}
Json quaternion(const Turn& turn) {
  constexpr int kFine = 7;
  return {{"x", rounded(turn.x, kFine)},
          {"y", rounded(turn.y, kFine)},
          {"z", rounded(turn.z, kFine)},
          {"w", rounded(turn.w, kFine)}};
}
Json pose_json(double x, double y, double z, const Turn& turn) {
  return {{"position", vector(x, y, z)}, {"orientation", quaternion(turn)}};
}
Json colour_json(sensor::Rgb rgb, double opacity) {
  constexpr double kFull = 255;
  return {{"r", rounded(rgb.red / kFull, kDecimals)},
          {"g", rounded(rgb.green / kFull, kDecimals)},
          {"b", rounded(rgb.blue / kFull, kDecimals)},
          {"a", opacity}};
}
Json header(double t, std::string_view frame) {
  const Stamp stamp(t);
  return {{"stamp", {{"sec", stamp.seconds}, {"nanosec", stamp.nanoseconds}}}, {"frame_id", frame}};
}

Json outlines(const Shown& shown) {
  constexpr int kLineLoop = 1;
  const Band band = band_of(shown.object);
  Json lines = Json::array();
  for (const Polygon& polygon : shown.outline.geometry) {
    Json points = Json::array();
    for (const Point& p : polygon.outer) points.push_back(vector(p.x, p.y, band.low));
    lines.push_back({{"type", kLineLoop},
                     {"pose", pose_json(0, 0, 0, {})},
                     {"thickness", kLineWidth},
                     {"scale_invariant", true},
                     {"points", std::move(points)},
                     {"color", colour_json(shown.colour, 1)},
                     {"colors", Json::array()},
                     {"indices", Json::array()}});
  }
  return lines;
}

Json solids(const Shown& shown) {
  const Band band = band_of(shown.object);
  const Mesh mesh = extruded(shown.outline.geometry, band.low, band.high);
  Json points = Json::array();
  for (const auto& [x, y, z] : mesh.points) {
    points.push_back(vector(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)));
  }
  return Json::array({{{"pose", pose_json(0, 0, 0, {})},
                       {"points", std::move(points)},
                       {"color", colour_json(shown.colour, is_solid(shown.object) ? 0.7 : 0.25)},
                       {"colors", Json::array()},
                       {"indices", mesh.indices}}});
}

Json labels(const Shown& shown) {
  const Polygon& first = shown.outline.geometry.front();
  Point middle;
  for (const Point& p : first.outer) middle = {middle.x + p.x, middle.y + p.y};
  const auto n = static_cast<double>(first.outer.size());
  const double z = band_of(shown.object).high + kLabelAbove;
  return Json::array({{{"pose", pose_json(middle.x / n, middle.y / n, z, {})},
                       {"billboard", true},
                       {"font_size", kFontSize},
                       {"scale_invariant", true},
                       {"color", colour_json({0x20, 0x20, 0x20}, 1)},
                       {"text", shown.title}}});
}

Json entity(double t, const Shown& shown) {
  const ObjectResult& object = shown.object;
  const auto entry = [](const char* key, std::string value) { return Json{{"key", key}, {"value", std::move(value)}}; };
  const int life = is_solid(object) ? 0 : kTentativeLife;
  return {{"timestamp", time(t)},
          {"frame_id", kMapFrame},
          {"id", std::to_string(object.id)},
          {"lifetime", {{"sec", life}, {"nsec", 0}}},
          {"frame_locked", false},
          {"metadata", Json::array({entry("state", std::string(record::name(object.state))),
                                    entry("model", shown.outline.name), entry("views", std::to_string(object.views)),
                                    entry("confidence", fmt::format("{:.2f}", object.confidence))})},
          {"arrows", Json::array()},
          {"cubes", Json::array()},
          {"spheres", Json::array()},
          {"cylinders", Json::array()},
          {"lines", outlines(shown)},
          {"triangles", solids(shown)},
          {"texts", labels(shown)},
          {"models", Json::array()}};
}

/// foxglove.Log's own numbers.
int foxglove_level(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear:
    case record::AlertLevel::kNotice: return 2;
    case record::AlertLevel::kWarn: return 3;
    case record::AlertLevel::kStop:
    case record::AlertLevel::kBlind: return 4;
  }
  return 0;
}

class FoxgloveJson final : public Encoding {
 public:
  [[nodiscard]] std::string_view profile() const override { return ""; }
  [[nodiscard]] std::string message_encoding() const override { return "json"; }

  [[nodiscard]] std::optional<Channel> channel(Topic topic) const override {
    constexpr const char* kSchemas = "jsonschema";
    switch (topic) {
      case Topic::kTransforms: return Channel{"/tf", {"foxglove.FrameTransform", kSchemas, frame_transform_schema()}};
      case Topic::kStaticTransforms: return std::nullopt;  // a viewer holds the last transform
      case Topic::kPose: return Channel{"/pose", {"foxglove.PoseInFrame", kSchemas, pose_in_frame_schema()}};
      case Topic::kOdometry: return Channel{"/odom", {"nav_msgs/msg/Odometry", kSchemas, odometry_schema()}};
      case Topic::kDetections:
        return Channel{"/detections", {"vision_msgs/msg/Detection2DArray", kSchemas, detections_schema()}};
      case Topic::kObjects: return Channel{"/objects", {"foxglove.SceneUpdate", kSchemas, scene_update_schema()}};
      case Topic::kAlerts: return Channel{"/alerts", {"foxglove.Log", kSchemas, log_schema()}};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::string transforms(double t, std::span<const Placement> placements) const override {
    const Placement& one = placements.front();  // each is a message here
    return text_of({{"timestamp", time(t)},
                    {"parent_frame_id", one.parent},
                    {"child_frame_id", one.child},
                    {"translation", vector(one.x, one.y, one.z)},
                    {"rotation", quaternion(one.turn)}});
  }
  [[nodiscard]] std::string pose(double t, const PoseResult& pose) const override {
    return text_of({{"timestamp", time(t)},
                    {"frame_id", kMapFrame},
                    {"pose", pose_json(pose.x, pose.y, 0, Turn::of(pose.heading))}});
  }
  [[nodiscard]] std::string odometry(double t, const Moving& moving) const override {
    const PoseResult& at = moving.pose;
    return text_of(
        {{"header", header(t, kMapFrame)},
         {"child_frame_id", kRobotFrame},
         {"pose", {{"pose", pose_json(at.x, at.y, 0, Turn::of(at.heading))}}},
         {"twist",
          {{"twist",
            {{"linear", vector(moving.forward, moving.left, 0)}, {"angular", vector(0, 0, moving.turning)}}}}}});
  }
  [[nodiscard]] std::string detections(double t, const Run& run, const sensor::BlobFrame& frame) const override {
    Json list = Json::array();
    for (const sensor::Blob& blob : frame.blobs) {
      const Box box(blob);
      const Json hypothesis = {{"class_id", signature_name(run.document, blob.signature)}, {"score", 1}};
      list.push_back({{"header", header(t, kCameraFrame)},
                      {"results", Json::array({{{"hypothesis", hypothesis}}})},
                      {"bbox",
                       {{"center", {{"position", {{"x", box.x}, {"y", box.y}}}, {"theta", 0}}},
                        {"size_x", box.width},
                        {"size_y", box.height}}},
                      {"id", track_of(blob)}});
    }
    return text_of({{"header", header(t, kCameraFrame)}, {"detections", std::move(list)}});
  }
  [[nodiscard]] std::string objects(const SceneChange& change) const override {
    constexpr int kMatchingId = 0;
    Json entities = Json::array();
    for (const Shown& shown : change.shown) entities.push_back(entity(change.t, shown));
    Json deletions = Json::array();
    for (const std::uint32_t id : change.gone) {
      deletions.push_back({{"timestamp", time(change.t)}, {"type", kMatchingId}, {"id", std::to_string(id)}});
    }
    return text_of({{"deletions", std::move(deletions)}, {"entities", std::move(entities)}});
  }
  [[nodiscard]] std::string alert(double t, record::AlertLevel level, std::string_view sentence) const override {
    return text_of({{"timestamp", time(t)},
                    {"level", foxglove_level(level)},
                    {"message", sentence},
                    {"name", "fencepost"},
                    {"file", ""},
                    {"line", 0}});
  }
};

}  // namespace

std::unique_ptr<Encoding> foxglove_json() { return std::make_unique<FoxgloveJson>(); }

}  // namespace fencepost::host::exports
