// Camera and wheels of a robot from an ordinary log (share/doc/calibrate.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/calibrate/parameters.hpp"
#include "host/calibrate/residuals.hpp"
#include "host/geometry/polygon.hpp"
#include "host/replay/replay.hpp"

namespace fencepost::host {

/// The mean width of all objects of a signature: the diameter of a round one, 2 (a + b) / pi of a box a x b.
struct NamedSize {
  std::string signature;  ///< its name, or its number
  double width = 0;       ///< m
};
struct NamedDistance {
  std::string a;
  std::string b;
  double distance = 0;  ///< m, middle to middle
};

struct CalibrateOptions {
  std::optional<sensor::CameraIntrinsics> camera;  ///< for logs without FPCAM
  std::optional<double> from;                      ///< s, stream time
  std::optional<double> to;
  std::vector<NamedSize> sizes;
  std::vector<NamedDistance> distances;
  std::function<void(double share)> progress{};  ///< hears now and then how much of the work is done, 0 to 1
};

/// One number: configured, found, and whether the log determines it.
struct Finding {
  std::string_view key;    ///< in JSON, such as "focal_length"
  std::string_view label;  ///< in text
  std::string_view unit;   ///< of the three, as shown: px, deg, ms, mm, %
  double configured = 0;
  double found = 0;  ///< where held, the configured value
  double sigma = 0;  ///< standard deviation
  int decimals = 2;
  bool observed = false;    ///< the log determines it better than the prior did
  bool held = false;        ///< keeps the configured value
  bool essential = false;   ///< without it the calibration is not complete
  std::string_view motion;  ///< the drive that would determine it
};

/// Of a colour's boxes: px that they are too wide on each side.
struct FoundPad {
  std::uint8_t signature = 0;
  double configured = 0;
  double found = 0;
  double sigma = 0;  ///< standard deviation
};

/// To the wheels' reported motion: factors minus 1, and what each metre turns unreported, rad.
struct WheelCorrection {
  double step = 0;
  double turn = 0;
  double curve = 0;
};

/// For the picture.
struct CalibratedObject {
  std::string name;
  sensor::Rgb rgb;
  Point centre;  ///< map, m
  LinearRing outline;
  std::vector<Point> feet_before;  ///< where each frame puts its foot on the floor, as configured and as found
  std::vector<Point> feet_after;
};

struct Calibration {
  std::size_t frames = 0;  ///< that count
  double seconds = 0;
  double driven = 0;  ///< m
  double turned = 0;  ///< rad
  std::vector<Finding> findings;
  Residuals before;
  Residuals after;
  sensor::CameraIntrinsics configured;
  sensor::CameraIntrinsics found;
  std::vector<record::Signature> signatures;  ///< with the pads that were found
  std::vector<FoundPad> pads;                 ///< that the log is sure of
  WheelCorrection wheels;
  std::vector<CalibratedObject> objects;
  std::vector<Point> way_before;
  std::vector<Point> way_after;
  /// Data that was left out and results that are uncertain, one sentence each.
  std::vector<std::string> notes;

  /// The log determines everything essential.
  [[nodiscard]] bool complete() const;
};

struct CalibrateOutcome {
  ReplayOutcome replay;  ///< how the log was read
  std::optional<Calibration> calibration;
  std::string refusal;  ///< without one: what the log lacks and what to drive
  bool usage = false;   ///< the refusal is about an option, not the log
};

/// `name` is used in messages only.
CalibrateOutcome calibrate(std::string_view bytes, const std::string& name, const CalibrateOptions& options);

}  // namespace fencepost::host
