// The findings of a replay, as the result document and the report show them (JSON: share/doc/results.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware/record/records.hpp"
#include "hal/sensor/camera.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::host {

struct Circle {
  Point center;
  double radius = 0;
};

/// One model of one object. `geometry` empty: the model has no area, `reason` says why.
struct ModelResult {
  std::string name;              ///< cylinder, cylinder_paper, carve, clip, ...
  MultiPolygon geometry;         ///< map frame, metres
  std::optional<Circle> circle;  ///< cylinders only
  std::string reason;
  /// The parts of a hybrid's outline of which no edge was seen. The object may go on there.
  std::vector<Polyline> open{};
};

/// From where an object should be looked at next.
struct NextViewResult {
  double bearing = 0;  ///< rad, of the camera as seen from the object, map axes
  double width = 0;    ///< rad, of the arc around it
  double x = 0;        ///< m, map frame: a place on it
  double y = 0;
  double gain = 0;  ///< share of the outline's area that a view from there may change
};

/// An object that the robot has driven past.
struct PassResult {
  double t = 0;
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  bool on_the_right = false;  ///< of the object, in the direction of the drive: it was to the robot's left
  double distance = 0;        ///< m, from the robot's origin to its nearest point when it was abeam
  double known_at = 0;        ///< s, when it was first confirmed and ahead
  double bearing = 0;         ///< rad, where it was then, from the robot
  double known_distance = 0;  ///< m
};

struct ObjectResult {
  std::uint32_t id = 0;
  std::uint8_t signature = 0;
  record::ObjectState state = record::ObjectState::kTentative;
  std::uint32_t views = 0;
  double z_min = 0;
  double z_max = 0;
  double confidence = 0;
  std::vector<ModelResult> models;
  double sigma = 0;  ///< m, of each coordinate of the cylinder's centre by its own views; 0: there is none
  double base = 0;   ///< m above the floor: its foot, or what hides it; 0 unless its rows contradict the floor
  std::optional<NextViewResult> next{};
};

struct PoseResult {
  double t = 0;
  double x = 0;
  double y = 0;
  double heading = 0;
};

/// A point of the floor in the map frame, m, where the guard knows the foot of something.
struct GuardPoint {
  double x = 0;
  double y = 0;
  std::uint8_t signature = 0;
};

/// Why a well-formed frame was not used.
struct RefusedFrames {
  std::uint64_t no_pose = 0;
  std::uint64_t odometry_gap = 0;
  std::uint64_t no_camera = 0;
  std::uint64_t queue = 0;
};

struct RejectedLines {
  std::uint64_t count = 0;
  std::uint64_t first_line = 0;  ///< 1-based; 0 when count is 0
};

struct LogCounts {
  std::uint64_t records = 0;  ///< accepted
  std::uint64_t frames = 0;
  std::uint64_t odometry = 0;
  std::uint64_t foreign = 0;
  RefusedFrames refused;
  std::array<RejectedLines, record::kRejectReasons> rejected{};
};

struct ResultDocument {
  LogCounts log;
  std::uint64_t digest = 0;
  std::string profile;
  std::optional<PoseResult> pose;                     ///< the last one
  std::vector<ObjectResult> objects;                  ///< every state
  std::vector<record::AlertReport> alerts;            ///< in order of time
  std::vector<GuardPoint> guard;                      ///< at the end: those that enough frames have seen to alert
  std::optional<record::WayReport> ways{};            ///< likewise
  std::optional<base::Metres> speed_limit{};          ///< m/s, likewise
  std::optional<record::SectorReport> sectors{};      ///< at the end; nothing of a profile that has none
  std::vector<record::CalibrationDoubt> calibration;  ///< each change of the robot's opinion of its calibration
  std::vector<PassResult> passes;                     ///< in order of time
  std::vector<PoseResult> path;                       ///< every odometry sample
  std::vector<record::Signature> signatures;
  std::optional<sensor::CameraIntrinsics> camera{};  ///< in force at the end
};

}  // namespace fencepost::host
