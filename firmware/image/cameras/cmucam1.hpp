// FENCEPOST_CAMERA=cmucam1: a CMUcam1 on a serial line at 115200 baud.
#pragma once

#include "firmware/image/cameras/cmucam.hpp"

namespace fencepost::image {

using Camera = CmuCamera<cmucam::kCmuCam1, 115'200>;

}  // namespace fencepost::image
