// Where common controllers put a wheel's count.
#pragma once

#include <cstdint>

#include "drivers/can_wheels/signal.hpp"

namespace fencepost::can_wheels {

/// CANopen (CiA 301, 402): TPDO1 of the node with its usual mapping, status word 6041 then position 6064, i32 counts.
constexpr Signal canopen_position(std::uint8_t node) { return {0x180U + node, false, 2, 4, false, true}; }

/// An id of FRC's 29 bits.
struct FrcId {
  std::uint8_t type = 0;  ///< 2: motor controller, 7: encoder
  std::uint8_t manufacturer = 0;
  std::uint8_t api_class = 0;  ///< 6 bits
  std::uint8_t index = 0;      ///< 4 bits
  std::uint8_t device = 0;     ///< 6 bits

  [[nodiscard]] constexpr std::uint32_t id() const {
    return std::uint32_t{type} << 24U | std::uint32_t{manufacturer} << 16U | std::uint32_t{api_class} << 10U |
           std::uint32_t{index} << 6U | device;
  }
};

/// Status 2 of a Talon SRX.
constexpr std::uint32_t talon_srx_status2(std::uint8_t device) { return FrcId{2, 4, 5, 1, device}.id(); }

/// CTRE Talon SRX, legacy firmware: status 2, every 20 ms; position, 24 bits, most significant byte first. A device
/// whose flag PosDiv8 is set counts in eights: scale accordingly.
constexpr Signal talon_srx_position(std::uint8_t device) { return {talon_srx_status2(device), true, 0, 3, true, true}; }
/// The same frame: velocity, counts per 100 ms.
constexpr Signal talon_srx_velocity(std::uint8_t device) { return {talon_srx_status2(device), true, 3, 2, true, true}; }

}  // namespace fencepost::can_wheels
