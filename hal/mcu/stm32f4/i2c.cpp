#include "hal/mcu/stm32f4/i2c.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/free_wires.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

// Between 88 and 100 kHz the set-up time of a repeated start is too short (errata ES0182).
constexpr std::uint32_t kBusHz = 80'000;

// 5 us at least, at 168 MHz: half a period of a bus at 100 kHz.
void pause() {
  for (int i = 0; i < 300; ++i) asm volatile("nop");
}

}  // namespace

void I2cRegisters::restart() const {
  write(kI2cControl1, 0);
  clock.make_open_output();
  data.make_open_output();
  free_wires(clock, data, [] { pause(); });
  clock.connect_open(kI2cFunction);
  data.connect_open(kI2cFunction);
  write(kI2cControl1, kI2cReset);
  write(kI2cControl1, 0);
  write(kI2cControl2, bus_hz / 1'000'000);                     // 27.6.2: the bus's clock, MHz
  write(kI2cClock, (bus_hz + 2 * kBusHz - 1) / (2 * kBusHz));  // 27.6.8: half a period
  write(kI2cRise, bus_hz / 1'000'000 + 1);                     // 27.6.9: 1000 ns, and one
  write(kI2cControl1, kI2cEnable);
}

void I2c::start(std::uint32_t bus_hz) {
  registers().bus_hz = bus_hz;
  enable_clock(kRccApb1Enable, kI2c1Clock);
  abandon();
  registers().restart();
  cortex_m::enable_interrupt(kInterruptI2c1Event);
  cortex_m::enable_interrupt(kInterruptI2c1Error);
}

}  // namespace fencepost::mcu::stm32f4
