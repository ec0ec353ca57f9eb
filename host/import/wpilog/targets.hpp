// Targets of one result of PhotonVision or a Limelight, as they lie in a log.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fencepost::host {

struct Target {
  std::string name;  ///< its kind: "class 3", "tag 7", "target"
  /// px, pixel centres on whole numbers: the first and the last inside. Without corners nothing.
  struct Box {
    double x1 = 0, y1 = 0, x2 = 0, y2 = 0;
  };
  std::optional<Box> box;
  double yaw = 0;    ///< rad, right positive
  double pitch = 0;  ///< rad, up positive
};

struct TargetFrame {
  double latency = 0;  ///< s, from exposure to the record
  std::vector<Target> targets;
};

/// Bytes of a photonstruct:PhotonPipelineResult of PhotonVision 2025 and later. errors: nothing for another layout
std::optional<TargetFrame> photon_targets(std::string_view data);

/// A Limelight's text `json`: its neural and colour targets. errors: nothing for what is no such text
std::optional<TargetFrame> limelight_json(std::string_view text);

/// A double[]. errors: nothing if the length is that of no array
std::optional<std::vector<double>> doubles_of(std::string_view data);

/// A Limelight's `rawdetections`: twelve numbers a target. errors: nothing for another length
std::optional<TargetFrame> limelight_detections(const std::vector<double>& values);

/// A Limelight's `tcornxy`: corners of its one target. errors: nothing for an odd length
std::optional<TargetFrame> limelight_corners(const std::vector<double>& values);

/// A Limelight's `tv`, `tx` and `ty`, degrees.
TargetFrame limelight_angles(bool seen, double tx, double ty);

}  // namespace fencepost::host
