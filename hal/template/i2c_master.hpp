// An I2C bus of a board.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"

namespace fencepost::port {

class I2cMaster {
 public:
  /// Fill in: copy `out` (at most bus::kMaxI2cTransfer bytes), send the start and the address; the interrupt does the
  /// rest: bytes, repeated start, reading, stop. kFull while one is under way, or where it is too long.
  /// Bound it: a device may stretch the clock indefinitely. Clock nine pulses by hand, reset the part, answer kRefused.
  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
    static_cast<void>(address);
    static_cast<void>(out);
    static_cast<void>(expected);
    return base::Error::kGone;
  }
  /// Fill in: kNotReady until the interrupt has seen the stop; then the bytes, or kRefused after a missing acknowledge.
  base::Result<std::size_t> finish(std::span<std::uint8_t> in) {
    static_cast<void>(in);
    return base::Error::kGone;
  }
};

static_assert(bus::I2cBus<I2cMaster>);

}  // namespace fencepost::port
