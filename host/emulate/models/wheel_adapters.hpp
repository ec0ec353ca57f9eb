// The wheel bases' models behind what all devices have in common.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "host/emulate/models/can_wheels.hpp"
#include "host/emulate/models/create.hpp"
#include "host/emulate/models/device_model.hpp"

namespace fencepost::emulate {

/// Dimensions of the wheels.
struct WheelShape {
  double tick = 0;   ///< m of the rim a count
  double track = 0;  ///< m between the wheels
};

/// Counts of a wheel that has come `way` metres, nearest.
std::int64_t counts_of(double way, double metres_per_count);

/// A Create 1 reports distance and turn, a Create 2 counts; its checksum takes the header in, the Create 1's does not.
std::unique_ptr<DeviceModel> make_create_model(CreateModel model, const WheelShape& wheels);

/// Motors B (left) and C (right), behind the length prefixes of Bluetooth. `camera_port` 1 to 4: an NXTCam there.
std::unique_ptr<DeviceModel> make_nxt_model(const WheelShape& wheels, std::optional<int> camera_port);

/// It sends frames as SocketCAN has them (struct can_frame, 16 bytes).
std::unique_ptr<DeviceModel> make_can_model(CanWheels::Kind kind, const WheelShape& wheels);

/// $FPODO lines without time, as a robot's own controller prints them: at each pose, else the last one again each
/// 40 ms.
std::unique_ptr<DeviceModel> make_records_model();

}  // namespace fencepost::emulate
