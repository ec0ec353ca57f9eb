// The key "can" of a robot file: the CAN frames and their bits that hold the wheels' numbers.
#pragma once

#include "drivers/can_wheels/wheels.hpp"
#include "host/live/robot_file.hpp"
#include "host/scene/json_reader.hpp"

namespace fencepost::host {

inline constexpr double kPicometresPerMetre = 1e12;

/// `wheels` has the track, and the way per count where the mapping gives no scale. errors: SceneProblem
can_wheels::Mapping read_can(const JsonNode& node, const WheelNumbers& wheels);

}  // namespace fencepost::host
