// The I2C master on the part's registers.
#pragma once

#include <cstdint>

#include "hal/mcu/nrf51/twi_master.hpp"
#include "hal/mcu/nrf52/pin.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf52 {

struct TwiRegisters {
  Pin clock;
  Pin data;

  [[nodiscard]] static std::uint32_t read(std::uint32_t offset) { return reg(nrf51::kTwi0 + offset); }
  static void write(std::uint32_t offset, std::uint32_t value) { reg(nrf51::kTwi0 + offset) = value; }
  /// Off and on, wires freed, 100 kHz: what a Pixy2 and an NXTCam both can. Not from an interrupt: it takes 0.2 ms.
  void restart() const;
};

class Twi : public nrf51::TwiMaster<TwiRegisters> {
 public:
  Twi(Pin clock, Pin data) : TwiMaster({clock, data}), wires_{clock, data} {}
  /// Before anything else here; again, for another device: what was under way ends.
  void start();

 private:
  TwiRegisters wires_;
};

static_assert(bus::I2cBus<Twi>);

}  // namespace fencepost::mcu::nrf52
