#include "hal/mcu/stm32f4/i2c.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/free_wires.hpp"

namespace fencepost::mcu::stm32f4 {
namespace {

constexpr std::uint32_t kPinFunction = 4;  // datasheet table 9: I2C1..3
constexpr std::uint32_t kBusHz = 100'000;

// At least 5 us at 168 MHz: half a period of the bus.
void pause() {
  for (int i = 0; i < 300; ++i) asm volatile("nop");
}

void take_wire(Pin pin) {
  pin.drive(true);
  pin.make_open_output();
}

}  // namespace

void I2cRegisters::restart() const {
  write(kI2cControl1, 0);
  take_wire(clock);
  take_wire(data);
  free_wires(clock, data, [] { pause(); });
  clock.connect_open(kPinFunction);
  data.connect_open(kPinFunction);
  write(kI2cControl1, kI2cReset);
  write(kI2cControl1, 0);
  write(kI2cControl2, bus_hz / 1'000'000);  // 27.6.2: the bus's clock, MHz
  write(kI2cClock, bus_hz / (2 * kBusHz));  // 27.6.8: half a period
  write(kI2cRise, bus_hz / 1'000'000 + 1);  // 27.6.9: 1000 ns, and one
  write(kI2cControl1, kI2cEnable);
}

void I2c::start(std::uint32_t bus_hz) {
  registers().bus_hz = bus_hz;
  set_bits(kRccApb1Enable, kI2c1Clock);
  registers().restart();
  cortex_m::enable_interrupt(kInterruptI2c1Event);
  cortex_m::enable_interrupt(kInterruptI2c1Error);
}

}  // namespace fencepost::mcu::stm32f4
