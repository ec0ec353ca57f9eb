// The blobs and poses of an importer's source, before they become a record stream.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/sensor/camera.hpp"
#include "host/import/import.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::host {

/// Inclusive pixels, as BlobFrame has them; not yet clamped to an image.
struct ImportedBlob {
  int signature = 1;
  double x1 = 0;
  double y1 = 0;
  double x2 = 0;
  double y2 = 0;
  std::optional<double> cx;  ///< the box's middle where the source does not give it
  std::optional<double> cy;
  std::uint32_t pixels = 0;
  std::optional<sensor::Rgb> rgb;
  std::uint16_t track = 0;  ///< id of a camera that tracks; 0: none
  bool bearing = false;     ///< no width: `cx` and `cy` have the middle, x1 and x2 mean nothing
};

struct TakenFrame {
  double t = 0;  ///< s, of any clock
  std::vector<ImportedBlob> blobs;
};

/// Measurements of a car: its encoder, and its steering angle or its gyro.
struct TakenCar {
  double t = 0;
  double driven = 0;               ///< m, of the middle of the unsteered axle since the start
  std::optional<double> steering;  ///< rad, left positive
  std::optional<double> yaw_rate;  ///< rad/s, counter-clockwise positive
};

struct Taken {
  std::vector<TakenFrame> frames;
  std::vector<TimedPose> poses;
  std::vector<TakenCar> car;                                  ///< in place of poses
  std::vector<std::pair<std::string, std::string>> settings;  ///< of the robot, as FPCFG
  std::map<int, std::string> names;                           ///< of signatures
  std::optional<std::pair<int, int>> image;                   ///< width and height, where the source gives them
  std::map<std::string, std::uint64_t> skipped;
  std::vector<std::string> notes;
};

/// Given by the user where the source does not know it.
struct TakeSettings {
  std::optional<sensor::CameraIntrinsics> camera;
  double rate = 20;              ///< frames a second, of texts without times
  std::vector<TimedPose> poses;  ///< of another file; empty: the source's own
};

/// Times from zero, each kind in order and strictly increasing; boxes clamped to the image, at most 16 a frame, the
/// largest first. Without poses and car the robot stands still, which is said. errors: ImportProblem: no frame and no
/// pose, no camera, a signature that is none
Imported log_of(Taken taken, const TakeSettings& settings, const std::string& source, const std::string& target);

}  // namespace fencepost::host
