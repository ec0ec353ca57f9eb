// A master on an I2C bus, for sensors that are read register by register.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"

namespace fencepost::bus {

/// Bytes of one transfer, each way. The NXT brick has the narrowest bus: 16.
inline constexpr std::size_t kMaxI2cTransfer = 32;

/// One transfer at a time, and no call waits.
/// `begin(address, out, expected)` writes `out` to the 7-bit address, then reads `expected` bytes after a repeated
/// start (either may be none). Answers how many bytes it will write. kFull: a transfer is under way, or it is too long.
/// `finish(in)` answers how many bytes were read into the front of `in`. kNotReady: still under way, or none was begun.
/// kRefused: nobody acknowledged. After any answer but kNotReady the bus is free. kGone, of both: there is no bus.
template <class T>
concept I2cBus = requires(T bus, std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected,
                          std::span<std::uint8_t> in) {
  { bus.begin(address, out, expected) } -> std::same_as<base::Result<std::size_t>>;
  { bus.finish(in) } -> std::same_as<base::Result<std::size_t>>;
};

}  // namespace fencepost::bus
