// A CMUcam on a byte link.
#pragma once

#include "drivers/cmucam/session.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::cmucam {

/// 115200 Bd 8N1, no flow control (CMUcam4: 19200). A frame's t is when the first byte of its first packet arrived.
template <bus::ByteLink Link>
using CmuCam = serial::Pump<Link, Session>;

static_assert(sensor::BlobCamera<CmuCam<serial::LinkArchetype>>);

}  // namespace fencepost::cmucam
