// World truth, camera, path and noise of one simulated run (the file layout is in share/doc/scene.md).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "firmware/record/records.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "host/geometry/polygon.hpp"
#include "host/scene/robot_body.hpp"

namespace fencepost::host {

struct SceneSignature {
  std::uint8_t id = 0;
  std::string name;
  sensor::Rgb rgb;
  std::uint16_t width = 0;  ///< mm, of all things of this colour, mean of all sides; 0: unknown
  std::int8_t pad = 0;      ///< px that the robot takes off each side of this colour's boxes

  [[nodiscard]] record::Signature recorded() const { return {id, rgb, sensor::Text(name), pad, width}; }
};

struct TimedPose {
  double t = 0;
  double x = 0;
  double y = 0;
  double heading = 0;
};

struct SceneObject {
  std::string name;
  std::uint8_t signature = 0;
  double base = 0;  ///< m above the floor
  double height_m = 0;
  Polygon
      footprint;  ///< map frame, m; a circle is given as a 256-gon of the circle's area. Of one that moves: at first
  std::vector<TimedPose> path{};  ///< of a point that is fixed to it, interpolated; empty: it is stationary
  std::optional<double> from{};   ///< s, it is there from then on
  std::optional<double> until{};  ///< s, and gone from then on
  bool trained = true;            ///< if not, the camera does not report it; it hides what is behind it all the same
};

/// The robot drives around `center`; the camera, not the robot, looks at the centre or outwards.
struct ArcPath {
  Point center;
  double radius = 1;
  double start = 0;  ///< rad
  double sweep = 0;  ///< rad, sign is the direction
  int views = 0;     ///< camera frames
  bool look_outwards = false;
};
struct WaypointPath {
  std::vector<Point> points;
  double speed = 0.2;      ///< m/s
  double turn_rate = 0.8;  ///< rad/s, turns on the spot
  double turn_radius = 0;  ///< m; not 0: drives round the points in arcs, as a car has to
  int laps = 0;            ///< rounds; not 0: the last point leads to the first, and the path ends there
  double wait = 0;         ///< s, stationary before it goes
};
struct PosesPath {
  std::vector<TimedPose> poses;  ///< interpolated, headings the short way round
};

/// Its wheels' readings.
struct SceneOdometry {
  enum class Kind : std::uint8_t { kPoses, kGyro, kSteering };
  Kind kind = Kind::kPoses;
  double counts = 0;     ///< of a car's encoder, a metre
  double wheelbase = 0;  ///< m
  [[nodiscard]] bool of_car() const { return kind != Kind::kPoses; }
};

/// All zero: only integer pixels. Meaning and unit of each key: share/doc/scene.md.
struct SceneNoise {
  double edge_px = 0;
  double edge_bias_px = 0;
  double loss_probability = 0;
  double loss_min = 0.1;
  double loss_max = 0.5;
  double split_share = 0.3;
  double growth_probability = 0;
  double growth_max = 0.3;
  double miss_probability = 0;
  double false_rate = 0;
  double signature_swap_probability = 0;
  double pose_xy = 0;
  double pose_heading = 0;
  double drift_scale = 0;
  double drift_turn = 0;
  double drift_walk = 0;
  double gyro_bias = 0;
  double gyro_walk = 0;
  double gyro_noise = 0;
  double gyro_scale = 0;
  double steer_offset = 0;
  double steer_scale = 0;
  double steer_backlash = 0;
  double yaw_error = 0;
  double pitch_error = 0;
  double latency_jitter = 0;
  double frame_drop_probability = 0;
  std::map<std::uint8_t, double> edge_bias_of{};  ///< of single signatures, px, in the place of edge_bias_px
};

struct Scene {
  std::uint64_t seed = 1;
  sensor::CameraIntrinsics camera;
  double rate = 50;  ///< frames/s
  int max_blobs = 16;
  RobotBody robot;
  std::vector<SceneSignature> signatures;
  std::vector<SceneObject> objects;
  std::variant<std::monostate, ArcPath, WaypointPath, PosesPath> path;
  SceneOdometry odometry;
  SceneNoise noise;
};

}  // namespace fencepost::host
