// A Newton Labs Cognachrome on a byte link.
#pragma once

#include "drivers/cognachrome/session.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::cognachrome {

/// 38400 baud, or the rate set in its monitor. A frame's t is when its mark arrived.
template <bus::ByteLink Link>
using Camera = serial::Pump<Link, Session>;

static_assert(sensor::BlobCamera<Camera<serial::LinkArchetype>>);

}  // namespace fencepost::cognachrome
