// A log as calibration reads it: the odometry, and which object was seen where in which frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/record/records.hpp"
#include "host/replay/replay.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// An object's box, continuous edges in px. An edge cut off by the border or by a nearer box is missing.
struct SeenBox {
  std::uint32_t object = 0;  ///< the run's own id
  std::uint8_t signature = 0;
  std::optional<double> left{};
  std::optional<double> right{};
  std::optional<double> foot{};
  std::optional<double> top{};
  double row_low = 0;
  double row_high = 0;
  double middle = 0;
};

struct SeenFrame {
  double t = 0;  ///< s, when it arrived
  std::vector<SeenBox> boxes;
  std::vector<SeenBox> others;  ///< no object took them; their id is 0
};

struct DriveLog {
  sensor::CameraIntrinsics camera;  ///< the last calibration; frames are of it
  bool camera_changed = false;      ///< there was another one before: its frames are left out
  std::vector<record::Signature> signatures;
  std::vector<TimedPose> odometry;
  std::vector<SeenFrame> frames;
  std::size_t ends = 0;      ///< left and right ends of all boxes
  std::size_t ends_cut = 0;  ///< of these, at the border or hidden
  std::size_t moving = 0;    ///< boxes of things that move: left out
};

/// The last run in `bytes`, associated by the robot's own tracking. `options`: camera, from, to, settings; the rest is
/// ours. `outcome` gets the replay's, with `unreadable` where nothing was usable.
DriveLog read_drive(std::string_view bytes, const std::string& name, ReplayOptions options, ReplayOutcome& outcome);

}  // namespace fencepost::host
