// One adapter, opened: transfers that wait.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hal/base/fixed.hpp"
#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/linux/descriptor.hpp"
#include "hal/linux/i2c.hpp"
#include "hal/linux/opened.hpp"

namespace fencepost::linux {

/// One write, one read after a repeated start, or either.
struct I2cTransfer {
  std::uint8_t address = 0;  ///< 7 bits
  base::FixedVector<std::uint8_t, bus::kMaxI2cTransfer> out;
  std::array<std::uint8_t, bus::kMaxI2cTransfer> in{};
  std::size_t expected = 0;
};

Opened<Descriptor> open_i2c_adapter(const I2cSettings& settings);

/// Waits. Answers how many bytes were read.
/// errors: kRefused: nobody acknowledged, or the bus is stuck; kGone: the adapter is not at its path any more.
base::Result<std::size_t> run_i2c_transfer(int fd, const std::string& path, I2cTransfer& transfer);

}  // namespace fencepost::linux
