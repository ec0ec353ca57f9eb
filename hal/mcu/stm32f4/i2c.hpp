// The I2C master on the part's registers: I2C1.
#pragma once

#include <cstdint>

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/i2c_master.hpp"
#include "hal/mcu/stm32f4/pin.hpp"

namespace fencepost::mcu::stm32f4 {

/// Of its pins (datasheet table 9).
inline constexpr std::uint32_t kI2cFunction = 4;

struct I2cRegisters {
  Pin clock;
  Pin data;
  std::uint32_t bus_hz = 0;  ///< of APB1

  [[nodiscard]] static std::uint32_t read(std::uint32_t offset) { return reg(kI2c1 + offset); }
  static void write(std::uint32_t offset, std::uint32_t value) { reg(kI2c1 + offset) = value; }
  /// Reset, wires freed, 80 kHz: what a Pixy2 and an NXTCam both can. Not from an interrupt: it takes 0.2 ms.
  void restart() const;
};

class I2c : public I2cMaster<I2cRegisters> {
 public:
  I2c(Pin clock, Pin data) : I2cMaster({clock, data, 0}) {}
  /// Before anything else here; again, for another device: what was under way ends. `bus_hz`: of APB1.
  void start(std::uint32_t bus_hz);
};

static_assert(bus::I2cBus<I2c>);

}  // namespace fencepost::mcu::stm32f4
