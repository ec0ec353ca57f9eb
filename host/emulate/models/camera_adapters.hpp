// The cameras' models behind what all devices have in common.
#pragma once

#include <memory>

#include "host/emulate/models/cmucam.hpp"
#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// On a UART.
std::unique_ptr<DeviceModel> make_pixy2_model();
/// Each blob is a spot of its own colour, else its signature's, else grey. The camera sees the spots inside the colour
/// window that the host requests.
std::unique_ptr<DeviceModel> make_cmucam_model(CmuCamModel model, Colours colours);
/// Signatures 1 to 3 are channels 0 to 2.
std::unique_ptr<DeviceModel> make_xbc_model();
/// The serial side, AVRcam's dialect; signatures are colours.
std::unique_ptr<DeviceModel> make_nxtcam_model();
std::unique_ptr<DeviceModel> make_nxtcam5_model();

}  // namespace fencepost::emulate
