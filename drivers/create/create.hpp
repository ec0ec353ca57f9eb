// An iRobot Create on a byte link.
#pragma once

#include "drivers/create/session.hpp"
#include "drivers/serial/pump.hpp"
#include "hal/sensor/sources.hpp"

namespace fencepost::create {

/// Create 1: 57600 Bd 8N1; Create 2 and Roomba 600: 115200. A sample's t is when the first byte of its frame arrived.
template <bus::ByteLink Link>
using Create = serial::Pump<Link, Session>;

static_assert(sensor::OdometrySource<Create<serial::LinkArchetype>>);

}  // namespace fencepost::create
