// What the choices cmucam1 to cmucam4 share; no choice itself.
#pragma once

#include "drivers/cmucam/cmucam.hpp"
#include "firmware/config/colours.hpp"
#include "firmware/console/counters.hpp"
#include FENCEPOST_BOARD

namespace fencepost::image {

template <const cmucam::Dialect& kDialect, std::uint32_t kBaud>
struct CmuCamera : cmucam::CmuCam<board::Link> {
  explicit CmuCamera(const console::Counters& /*counters*/) : cmucam::CmuCam<board::Link>(board::camera(), wanted()) {}
  static void start() { board::start_camera(kBaud); }
  static sensor::CameraIntrinsics calibration() { return cmucam::nominal_intrinsics(kDialect, {}); }

 private:
  static cmucam::Config wanted() {
    cmucam::Config config;
    config.dialect = &kDialect;
    for (const cmucam::ColourWindow& colour : fencepost::config::kColours)
      static_cast<void>(config.windows.push_back(colour));
    return config;
  }
};

}  // namespace fencepost::image
