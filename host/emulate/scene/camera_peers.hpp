// The emulated cameras as peers.
#pragma once

#include <functional>
#include <memory>

#include "hal/sensor/blob_frame.hpp"
#include "host/emulate/models/cmucam.hpp"
#include "host/emulate/scene/peer.hpp"

namespace fencepost::emulate {

/// Mean colour of a signature's things, where the feed tells it.
using Colours = std::function<std::optional<sensor::Rgb>(std::uint8_t)>;

/// On a UART.
std::unique_ptr<Peer> make_pixy2_peer();
/// Each blob is a spot of its own colour, else its signature's, else grey; the camera sees those inside the window that
/// the host asks for.
std::unique_ptr<Peer> make_cmucam_peer(CmuCamModel model, Colours colours);
/// Signatures 1 to 3 are channels 0 to 2.
std::unique_ptr<Peer> make_xbc_peer();
/// The serial side, AVRcam's dialect; signatures are colours.
std::unique_ptr<Peer> make_nxtcam_peer();
std::unique_ptr<Peer> make_nxtcam5_peer();

}  // namespace fencepost::emulate
