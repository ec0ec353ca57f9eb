// A JeVois on a byte link.
#pragma once

#include "drivers/jevois/session.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::jevois {

/// 115200 Bd 8N1, or its own USB port. A frame's t is when the first byte of its first mark arrived.
template <bus::ByteLink Link>
using JeVois = serial::Pump<Link, Session>;

static_assert(sensor::BlobCamera<JeVois<serial::LinkArchetype>>);

}  // namespace fencepost::jevois
