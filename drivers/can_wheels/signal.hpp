// One number inside CAN frames.
#pragma once

#include <cstdint>
#include <optional>

#include "hal/bus/can_bus.hpp"

namespace fencepost::can_wheels {

/// A signal as a DBC file describes it, for whole bytes. Intel (@1): `first_byte` is the start bit / 8. Motorola (@0):
/// it is the byte of the start bit, the most significant one. Extended identifiers lack bit 31 of the DBC number.
struct Signal {
  std::uint32_t id = 0;
  bool extended = false;
  std::uint8_t first_byte = 0;
  std::uint8_t size = 4;  ///< bytes, 1..4
  bool big_endian = false;
  bool is_signed = true;
};

/// errors: empty if the frame has another id, is a remote request, or too short
std::optional<std::int64_t> value_in(const bus::CanFrame& frame, const Signal& signal);

/// Whether the frame is the signal's, long enough or not.
bool carries(const bus::CanFrame& frame, const Signal& signal);

}  // namespace fencepost::can_wheels
