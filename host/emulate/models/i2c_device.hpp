// Something on an I2C bus, as the bus sees it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/base/units.hpp"

namespace fencepost::emulate {

class I2cDevice {
 public:
  virtual ~I2cDevice() = default;
  /// Writes, then reads after a repeated start. Nothing: not acknowledged. `address`: 7 bits.
  virtual std::optional<std::vector<std::uint8_t>> transfer(std::uint8_t address, const std::vector<std::uint8_t>& out,
                                                            std::size_t expected, base::Time now) = 0;
};

}  // namespace fencepost::emulate
