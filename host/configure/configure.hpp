// What a robot is told before it starts for the first time: settings, calibration and colours, in its image's file.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
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
  std::string board;
  std::string version;
  std::vector<std::string> told;  ///< the lines, without their ends
  std::size_t used = 0;           ///< bytes
  std::size_t room = 0;
};

/// Does it say of itself what is needed?
bool can_be_configured(const ImageMemory& image);

/// Settings that the file had are gone. `image`: as read_image() has it.
/// errors: what cannot be, and what to do; of an image that can be configured
base::Result<ConfiguredImage, std::string> configure(const ImageMemory& image, const ConfigureRequest& request);

}  // namespace fencepost::host
