// A KIPR XBC on a byte link.
#pragma once

#include "drivers/serial/pump.hpp"
#include "drivers/xbc/session.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::xbc {

/// 38400 Bd 8N1, or what fencepost_xbc.ic was set to. A frame's t is when the first byte of its line F arrived.
template <bus::ByteLink Link>
using Xbc = serial::Pump<Link, Session>;

static_assert(sensor::BlobCamera<Xbc<serial::LinkArchetype>>);

}  // namespace fencepost::xbc
