// The cameras `cmucam1` to `cmucam4` on a serial line. They get the colours that are configured on the robot ($FPSIG),
// or else those of firmware/config/colours.hpp.
#pragma once

#include <array>

#include "drivers/cmucam/cmucam.hpp"
#include "firmware/config/colours.hpp"
#include "firmware/image/opening.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

struct CmuCam : cmucam::CmuCam<board::Link> {
  static constexpr std::array kCameras = {config::CameraId::kCmucam1, config::CameraId::kCmucam2,
                                          config::CameraId::kCmucam3, config::CameraId::kCmucam4};
  explicit CmuCam(const Opening& opening) : cmucam::CmuCam<board::Link>(board::camera(), wanted(opening)) {}
  static void start(const Opening& opening) { board::start_camera(opening.camera_baud()); }

 private:
  static const cmucam::Dialect& dialect(config::CameraId camera) {
    switch (camera) {
      case config::CameraId::kCmucam2: return cmucam::kCmuCam2;
      case config::CameraId::kCmucam3: return cmucam::kCmuCam3;
      case config::CameraId::kCmucam4: return cmucam::kCmuCam4;
      default: return cmucam::kCmuCam1;
    }
  }
  static cmucam::Config wanted(const Opening& opening) {
    cmucam::Config config;
    config.dialect = &dialect(opening.devices.camera());
    for (const record::Signature& colour : opening.signatures)
      static_cast<void>(config.windows.push_back(config::window_around(colour)));
    if (!config.windows.empty()) return config;
    for (const cmucam::ColourWindow& colour : fencepost::config::kColours)
      static_cast<void>(config.windows.push_back(colour));
    return config;
  }
};

}  // namespace fencepost::image
