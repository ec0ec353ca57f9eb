// FENCEPOST_CAMERA=cmucam3: a CMUcam3 on a serial line at 115200 baud.
#pragma once

#include "firmware/image/cameras/cmucam.hpp"

namespace fencepost::image {

using Camera = CmuCamera<cmucam::kCmuCam3, 115'200>;

}  // namespace fencepost::image
