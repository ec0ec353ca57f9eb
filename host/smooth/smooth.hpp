// The whole log at once: poses, objects and, on request, calibration as one least-squares problem
// (share/doc/smooth.md).
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/calibrate/calibrate.hpp"
#include "host/replay/replay.hpp"
#include "host/smooth/par.hpp"

namespace fencepost::host {

struct SmoothOptions {
  std::string profile;                             ///< of the online map, as ReplayOptions
  std::optional<sensor::CameraIntrinsics> camera;  ///< for logs without FPCAM
  std::optional<double> from;                      ///< s, stream time
  std::optional<double> to;
  bool calibrate = false;                        ///< focal length, yaw, pitch, latency, mount are estimated, too
  std::function<void(double share)> progress{};  ///< hears now and then how much of the work is done, 0 to 1
};

/// One object of the optimum.
struct SmoothedObject {
  std::uint32_t id = 0;  ///< that of the replay's object that it began with
  std::uint8_t signature = 0;
  std::size_t sightings = 0;  ///< in the frames that count
  Point centre;               ///< map, m
  std::optional<double>
      sigma;           ///< m, of its place seen from the first pose: the longer half axis; nothing where it is open
  double radius = 0;   ///< m
  double top = 0;      ///< m over the floor; 0 where rows are not used
  LinearRing outline;  ///< map, m
};

struct Smoothed {
  ResultDocument online;  ///< the replay of the log as it is
  ResultDocument
      optimum;  ///< the same of the optimum: models `cylinder`, `optimum` and `online`, this one moved onto it
  std::vector<SmoothedObject> objects;
  Par par;  ///< online against optimum
  sensor::CameraIntrinsics camera;
  std::vector<Finding> findings;  ///< of camera and wheels, where they were asked for

  std::size_t frames = 0;  ///< that count
  std::size_t poses = 0;   ///< that were estimated
  std::size_t sightings = 0;
  std::size_t joined = 0;      ///< objects that were another one
  std::size_t left_out = 0;    ///< objects that fit no place
  std::size_t added = 0;       ///< boxes that no object had taken online
  std::size_t taken_back = 0;  ///< boxes that fit no object of their colour
  double seconds = 0;
  double driven = 0;        ///< m
  double turned = 0;        ///< rad
  double drift = 0;         ///< the odometry's random errors of turns over those of good wheels
  double walk = 0;          ///< and those of ways
  double edges_before = 0;  ///< px, 68 % are nearer: by the online path, each object where it fits best
  double edges_after = 0;
  std::vector<std::string> notes;
};

struct SmoothOutcome {
  ReplayOutcome replay;  ///< how the log was read
  std::optional<Smoothed> smoothed;
  std::string refusal;  ///< without one: what the log lacks and what to try
};

/// `name` is used in messages only.
SmoothOutcome smooth(std::string_view bytes, const std::string& name, const SmoothOptions& options);

}  // namespace fencepost::host
