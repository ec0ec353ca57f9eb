// A run as messages for a viewer, in one of the vocabularies that viewers know.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "host/export/mcap/mcap_writer.hpp"
#include "host/export/run.hpp"

namespace fencepost::host::exports {

inline constexpr int kTentativeLife = 2;  ///< s; confirmed objects stay until they are deleted
inline constexpr std::string_view kMapFrame = "map";
inline constexpr std::string_view kRobotFrame = "base_link";
inline constexpr std::string_view kCameraFrame = "camera";  ///< at the lens, x along the optical axis, z up

enum class Topic : std::uint8_t { kTransforms, kStaticTransforms, kPose, kOdometry, kDetections, kObjects, kAlerts };
inline constexpr std::size_t kTopics = 7;

/// A unit quaternion.
struct Turn {
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 1;
  /// rad; pitch positive looks down.
  static Turn of(double yaw, double pitch = 0);
};

struct Placement {
  std::string_view parent;
  std::string_view child;
  double x = 0;
  double y = 0;
  double z = 0;
  Turn turn;
};

/// A pose with speeds, m/s forward and to the left, rad/s.
struct Moving {
  PoseResult pose;
  double forward = 0;
  double left = 0;
  double turning = 0;
};

/// An object in three dimensions.
struct Shown {
  const ObjectResult& object;
  const ModelResult& outline;
  std::string title;
  sensor::Rgb colour;
};

struct SceneChange {
  double t = 0;
  std::vector<Shown> shown;
  std::vector<std::uint32_t> gone;  ///< ids
};

/// Times are s, as messages hold them; each function gives the bytes of one message.
class Encoding {
 public:
  virtual ~Encoding() = default;

  [[nodiscard]] virtual std::string_view profile() const = 0;
  [[nodiscard]] virtual std::string message_encoding() const = 0;
  struct Channel {
    std::string topic;
    McapSchema schema;
    std::map<std::string, std::string> metadata{};
  };
  /// Nothing: this vocabulary says it by another, static transforms by kTransforms.
  [[nodiscard]] virtual std::optional<Channel> channel(Topic topic) const = 0;

  /// Adds the metadata of the whole file.
  virtual void add_metadata(McapWriter& /*writer*/) const {}

  [[nodiscard]] virtual std::string transforms(double t, std::span<const Placement> placements) const = 0;
  [[nodiscard]] virtual std::string pose(double t, const PoseResult& pose) const = 0;
  [[nodiscard]] virtual std::string odometry(double t, const Moving& moving) const = 0;
  /// `t`: of the exposure.
  [[nodiscard]] virtual std::string detections(double t, const Run& run, const sensor::BlobFrame& frame) const = 0;
  [[nodiscard]] virtual std::string objects(const SceneChange& change) const = 0;
  [[nodiscard]] virtual std::string alert(double t, record::AlertLevel level, std::string_view sentence) const = 0;
};

std::unique_ptr<Encoding> foxglove_json();
std::unique_ptr<Encoding> ros2_cdr();

/// Whole seconds and nanoseconds.
struct Stamp {
  explicit Stamp(double t);
  std::int64_t seconds;
  std::uint32_t nanoseconds;
};

/// A box as ROS has it: continuous pixels, its middle and its sizes.
struct Box {
  explicit Box(const sensor::Blob& blob);
  double x;
  double y;
  double width;
  double height;
};

/// The id of the camera's tracker as a detection's `id`; empty: none.
std::string track_of(const sensor::Blob& blob);

}  // namespace fencepost::host::exports
