// Where common controllers put a wheel's count.
#pragma once

#include <cstdint>

#include "drivers/can_wheels/signal.hpp"

namespace fencepost::can_wheels {

/// CANopen (CiA 301, 402): TPDO1 of the node with its usual mapping, status word 6041 then position 6064, i32 counts.
constexpr Signal canopen_position(std::uint8_t node) { return {0x180U + node, false, 2, 4, false, true}; }

/// CTRE Talon SRX, legacy firmware: status 2, every 20 ms; position, 24 bits, most significant byte first. A device
/// whose flag PosDiv8 is set counts in eights: scale accordingly.
constexpr Signal talon_srx_position(std::uint8_t device) { return {0x02041440U + device, true, 0, 3, true, true}; }
/// The same frame: velocity, counts per 100 ms.
constexpr Signal talon_srx_velocity(std::uint8_t device) { return {0x02041440U + device, true, 3, 2, true, true}; }

}  // namespace fencepost::can_wheels
