// The emulated wheel bases as peers.
#pragma once

#include <memory>
#include <optional>

#include "host/emulate/models/can_wheels.hpp"
#include "host/emulate/models/create.hpp"
#include "host/emulate/scene/peer.hpp"

namespace fencepost::emulate {

/// Of both wheels.
struct WheelShape {
  double tick = 0;   ///< m of the rim a count
  double track = 0;  ///< m between the wheels
};

/// A Create 1 tells way and turn, a Create 2 counts; its checksum takes the header in, the Create 1's does not.
std::unique_ptr<Peer> make_create_peer(CreateModel model, const WheelShape& wheels);

/// Motors B (left) and C (right), behind the length prefixes of Bluetooth. `camera_port` 1 to 4: an NXTCam there.
std::unique_ptr<Peer> make_nxt_peer(const WheelShape& wheels, std::optional<int> camera_port);

/// What it says are frames as SocketCAN has them (struct can_frame, 16 bytes).
std::unique_ptr<Peer> make_can_peer(CanWheels::Kind kind, const WheelShape& wheels);

/// $FPODO lines without time, as a robot's own controller prints them: at each pose, else the last one again each
/// 40 ms.
std::unique_ptr<Peer> make_records_peer();

}  // namespace fencepost::emulate
