// Messages as CDR, as ROS 2 names and lays them out: RViz, rosbag2, Foxglove.
#include "host/export/mcap/cdr_writer.hpp"
#include "host/export/mcap/encoding.hpp"
#include "host/export/mcap/ros2_definitions.hpp"
#include "host/export/prism.hpp"
#include "host/result/lookup.hpp"

namespace fencepost::host::exports {
namespace {

constexpr int kCovariance = 36;

/// Quality of service of a latched topic, as rosbag2 wrote it up to Iron. The numbers are rmw's: keep last, reliable,
/// transient local, automatic liveliness. The times are infinite.
constexpr const char* kLatched =
    "- history: 1\n"
    "  depth: 1\n"
    "  reliability: 1\n"
    "  durability: 1\n"
    "  deadline: {sec: 9223372036, nsec: 854775807}\n"
    "  lifespan: {sec: 9223372036, nsec: 854775807}\n"
    "  liveliness: 1\n"
    "  liveliness_lease_duration: {sec: 9223372036, nsec: 854775807}\n"
    "  avoid_ros_namespace_conventions: false\n";

enum Marker : std::int32_t { kLineStrip = 4, kText = 9, kTriangles = 11 };
enum Action : std::int32_t { kAdd = 0, kDelete = 2 };

void stamp(CdrWriter& cdr, double t) {
  const Stamp stamp(t);
  cdr.signed_whole(static_cast<std::int32_t>(stamp.seconds)).whole(stamp.nanoseconds);
}
void header(CdrWriter& cdr, double t, std::string_view frame) {
  stamp(cdr, t);
  cdr.string(frame);
}
void vector(CdrWriter& cdr, double x, double y, double z) { cdr.real(x).real(y).real(z); }
void quaternion(CdrWriter& cdr, const Turn& turn) { cdr.real(turn.x).real(turn.y).real(turn.z).real(turn.w); }
void colour(CdrWriter& cdr, sensor::Rgb rgb, float opacity) {
  constexpr float kFull = 255;
  cdr.single(rgb.red / kFull).single(rgb.green / kFull).single(rgb.blue / kFull).single(opacity);
}

/// A marker's identity is its namespace and number.
struct MarkerHead {
  double t;
  std::string_view ns;
  std::uint32_t id;
  Marker type;
  Action action;
};

struct MarkerBody {
  Point at;
  double z = 0;
  double size = 1;  ///< of lines their width, of texts the height of a letter; m
  sensor::Rgb rgb;
  float opacity = 1;
  int life = 0;  ///< s; 0: until it is deleted
  std::vector<std::array<double, 3>> points;
  std::string_view text;
};

void marker(CdrWriter& cdr, const MarkerHead& head, const MarkerBody& body) {
  header(cdr, head.t, kMapFrame);
  cdr.string(head.ns).signed_whole(static_cast<std::int32_t>(head.id)).signed_whole(head.type);
  cdr.signed_whole(head.action);
  vector(cdr, body.at.x, body.at.y, body.z);
  quaternion(cdr, {});
  vector(cdr, body.size, body.size, body.size);
  colour(cdr, body.rgb, body.opacity);
  cdr.signed_whole(body.life).whole(0);
  cdr.byte(0);  // frame_locked
  cdr.whole(static_cast<std::uint32_t>(body.points.size()));
  for (const auto& [x, y, z] : body.points) vector(cdr, x, y, z);
  cdr.whole(0);  // colors
  cdr.string("");
  cdr.signed_whole(0).whole(0).string("").string("").whole(0);  // texture
  cdr.whole(0);                                                 // uv_coordinates
  cdr.string(body.text).string("");
  cdr.string("").whole(0);  // mesh_file
  cdr.byte(0);
}

constexpr int kMarkersAnObject = 3;

void markers(CdrWriter& cdr, double t, const Shown& shown) {
  constexpr double kLine = 0.005;
  constexpr double kLetter = 0.06;
  const Band band = band_of(shown.object);
  const std::uint32_t id = shown.object.id;
  MarkerBody body;
  body.rgb = shown.colour;
  body.life = is_solid(shown.object) ? 0 : kTentativeLife;

  MarkerBody outline = body;
  outline.size = kLine;
  const LinearRing& ring = shown.outline.geometry.front().outer;
  Point middle;
  for (const Point& p : ring) {
    outline.points.push_back({p.x, p.y, band.low});
    middle = {middle.x + p.x, middle.y + p.y};
  }
  outline.points.push_back(outline.points.front());
  marker(cdr, {t, "outlines", id, kLineStrip, kAdd}, outline);

  MarkerBody solid = body;
  solid.opacity = is_solid(shown.object) ? 0.7F : 0.25F;
  const Mesh mesh = extruded(shown.outline.geometry, band.low, band.high);
  for (const std::uint32_t i : mesh.indices) {
    const auto& [x, y, z] = mesh.points[i];
    solid.points.push_back({static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)});
  }
  marker(cdr, {t, "solids", id, kTriangles, kAdd}, solid);

  MarkerBody label = body;
  const auto n = static_cast<double>(ring.size());
  label.at = {middle.x / n, middle.y / n};
  label.z = band.high + kLetter;
  label.size = kLetter;
  label.text = shown.title;
  marker(cdr, {t, "names", id, kText, kAdd}, label);
}

/// rcl_interfaces/msg/Log's own numbers.
std::uint8_t log_level(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear:
    case record::AlertLevel::kNotice: return 20;
    case record::AlertLevel::kWarn: return 30;
    case record::AlertLevel::kStop:
    case record::AlertLevel::kBlind: return 40;
  }
  return 20;
}

class Ros2Cdr final : public Encoding {
 public:
  [[nodiscard]] std::string_view profile() const override { return "ros2"; }
  [[nodiscard]] std::string message_encoding() const override { return "cdr"; }

  [[nodiscard]] std::optional<Channel> channel(Topic topic) const override {
    const auto of = [](const char* name, const char* type, const char* quality = "") {
      // rosbag2 looks for this key; empty means its defaults.
      return Channel{name, {type, "ros2msg", ros2_definition(type)}, {{"offered_qos_profiles", quality}}};
    };
    switch (topic) {
      case Topic::kTransforms: return of("/tf", "tf2_msgs/msg/TFMessage");
      case Topic::kStaticTransforms: return of("/tf_static", "tf2_msgs/msg/TFMessage", kLatched);
      case Topic::kPose: return std::nullopt;  // the odometry has it
      case Topic::kOdometry: return of("/odom", "nav_msgs/msg/Odometry");
      case Topic::kDetections: return of("/detections", "vision_msgs/msg/Detection2DArray");
      case Topic::kObjects: return of("/objects", "visualization_msgs/msg/MarkerArray");
      case Topic::kAlerts: return of("/alerts", "rcl_interfaces/msg/Log");
    }
    return std::nullopt;
  }

  /// Without this record rosbag2 expects words in kLatched since Jazzy; no earlier one reads it.
  void add_metadata(McapWriter& writer) const override {
    writer.add_metadata("rosbag2", {{"serialized_metadata", ""}});
  }

  [[nodiscard]] std::string transforms(double t, std::span<const Placement> placements) const override {
    CdrWriter cdr;
    cdr.whole(static_cast<std::uint32_t>(placements.size()));
    for (const Placement& one : placements) {
      header(cdr, t, one.parent);
      cdr.string(one.child);
      vector(cdr, one.x, one.y, one.z);
      quaternion(cdr, one.turn);
    }
    return cdr.bytes();
  }
  [[nodiscard]] std::string pose(double /*t*/, const PoseResult& /*pose*/) const override { return {}; }
  [[nodiscard]] std::string odometry(double t, const Moving& moving) const override {
    CdrWriter cdr;
    header(cdr, t, kMapFrame);
    cdr.string(kRobotFrame);
    vector(cdr, moving.pose.x, moving.pose.y, 0);
    quaternion(cdr, Turn::of(moving.pose.heading));
    cdr.zeros(kCovariance);
    vector(cdr, moving.forward, moving.left, 0);
    vector(cdr, 0, 0, moving.turning);
    cdr.zeros(kCovariance);
    return cdr.bytes();
  }
  [[nodiscard]] std::string detections(double t, const Run& run, const sensor::BlobFrame& frame) const override {
    CdrWriter cdr;
    header(cdr, t, kCameraFrame);
    cdr.whole(static_cast<std::uint32_t>(frame.blobs.size()));
    for (const sensor::Blob& blob : frame.blobs) {
      header(cdr, t, kCameraFrame);
      cdr.whole(1).string(signature_name(run.document, blob.signature)).real(1);
      vector(cdr, 0, 0, 0);
      quaternion(cdr, {});
      cdr.zeros(kCovariance);
      const Box box(blob);
      cdr.real(box.x).real(box.y).real(0).real(box.width).real(box.height).string(track_of(blob));
    }
    return cdr.bytes();
  }
  [[nodiscard]] std::string objects(const SceneChange& change) const override {
    CdrWriter cdr;
    cdr.whole(static_cast<std::uint32_t>(kMarkersAnObject * (change.shown.size() + change.gone.size())));
    for (const Shown& shown : change.shown) markers(cdr, change.t, shown);
    for (const std::uint32_t id : change.gone) {
      marker(cdr, {change.t, "outlines", id, kLineStrip, kDelete}, {});
      marker(cdr, {change.t, "solids", id, kTriangles, kDelete}, {});
      marker(cdr, {change.t, "names", id, kText, kDelete}, {});
    }
    return cdr.bytes();
  }
  [[nodiscard]] std::string alert(double t, record::AlertLevel level, std::string_view sentence) const override {
    CdrWriter cdr;
    stamp(cdr, t);
    cdr.byte(log_level(level)).string("fencepost").string(sentence).string("").string("").whole(0);
    return cdr.bytes();
  }
};

}  // namespace

std::unique_ptr<Encoding> ros2_cdr() { return std::make_unique<Ros2Cdr>(); }

}  // namespace fencepost::host::exports
