// Writes settings, calibration and colours into an image's file before the robot's first start.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/base/result.hpp"
#include "hal/sensor/camera.hpp"
#include "host/configure/image_file.hpp"
#include "host/live/robot_file.hpp"

namespace fencepost::host {

struct ConfigureRequest {
  /// As on the console, in this order: camera, lens, odometry and all others.
  std::vector<std::pair<std::string, std::string>> settings;
  RobotFile robot;
  std::optional<sensor::CameraIntrinsics>
      calibration;  ///< instead of the camera's own; the robot file's numbers go on top
};

struct ConfiguredImage {
  ImageMemory memory;      ///< of the image and its settings; of a cartridge's settings alone
  bool cartridge = false;  ///< the settings are in a memory of their own, which `memory` is
  bool uf2 = false;        ///< its part takes such files
  bool dfu = false;        ///< likewise
  std::string board;
  std::string version;
  std::vector<std::string> configured;  ///< the lines, without their ends
  std::size_t used = 0;                 ///< bytes
  std::size_t room = 0;
};

/// The choices that an image leaves.
struct ImageChoices {
  struct Camera {
    std::string name;
    bool delivered = false;               ///< resolution and lens are known; it can be mounted
    std::vector<std::string> odometries;  ///< that this board can have beside it, at least one
  };
  std::string board;
  std::string version;
  bool cartridge = false;  ///< these three as in ConfiguredImage
  bool uf2 = false;
  bool dfu = false;
  std::vector<Camera> cameras;
  std::vector<std::pair<std::string, std::string>> initial;  ///< settings of devices, as written on the console
};

/// A refusal: the reason, and a remedy. It leaves this folder only where nothing catches: in WebAssembly
/// (host/web/wasm/exports.cpp).
struct ConfigureProblem {
  std::string message;
};

/// errors: as configure() has them, of a file that is no image
base::Result<ImageChoices, std::string> choices(const ImageMemory& image);

/// The image has the description of itself that is needed.
bool can_be_configured(const ImageMemory& image);

/// Settings that the file had are gone. `image`: as read_image() has it.
/// errors: what cannot be, and what to do; of an image that can be configured
base::Result<ConfiguredImage, std::string> configure(const ImageMemory& image, const ConfigureRequest& request);

}  // namespace fencepost::host
