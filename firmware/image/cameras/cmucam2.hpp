// FENCEPOST_CAMERA=cmucam2: a CMUcam2 on a serial line at 115200 baud.
#pragma once

#include "firmware/image/cameras/cmucam.hpp"

namespace fencepost::image {

using Camera = CmuCamera<cmucam::kCmuCam2, 115'200>;

}  // namespace fencepost::image
