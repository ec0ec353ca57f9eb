// FENCEPOST_CAMERA=cmucam4: a CMUcam4 on a serial line at 19200 baud.
#pragma once

#include "firmware/image/cameras/cmucam.hpp"

namespace fencepost::image {

using Camera = CmuCamera<cmucam::kCmuCam4, 19'200>;

}  // namespace fencepost::image
