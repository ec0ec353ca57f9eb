// An I2C bus: the part's own master, fed by its interrupt.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/bus/i2c_bus.hpp"
#include "hal/mcu/rp2/pin.hpp"

namespace fencepost::mcu::rp2 {

struct I2cWiring {
  std::uint32_t base = 0;
  std::uint32_t reset = 0;
  std::uint32_t interrupt = 0;
  Pin data;
  Pin clock;
};

class I2c {
 public:
  /// Before anything else here; again, for another device: what was under way ends. `clock_hz`: of the peripherals.
  /// 100 kHz is what every device on such a bus can.
  void start(const I2cWiring& wiring, std::uint32_t clock_hz, std::uint32_t bus_hz = 100'000);

  base::Result<std::size_t> begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected);
  /// Where a device has held the bus for longer than kLongest, it is freed: some 0.1 ms, the only wait here.
  base::Result<std::size_t> finish(std::span<std::uint8_t> in);

  /// The bus's interrupt.
  void on_interrupt();

 private:
  // The longest transfer takes 65 bytes of 9 bits at 100 kHz, 6 ms; devices may stretch the clock.
  static constexpr std::uint32_t kLongest = 30'000;  // us

  void set_up();
  void free_bus() const;
  void command_more();
  [[nodiscard]] std::uint32_t command(std::size_t n) const;

  I2cWiring wiring_;
  std::uint32_t clock_hz_ = 0;
  std::uint32_t bus_hz_ = 0;
  std::array<std::uint8_t, bus::kMaxI2cTransfer> bytes_{};  ///< to write, then those that were read
  std::size_t written_ = 0;                                 ///< of all bytes to write
  std::size_t expected_ = 0;
  std::size_t commanded_ = 0;  ///< of both
  volatile std::size_t read_ = 0;
  volatile bool stopped_ = false;
  volatile bool refused_ = false;
  volatile bool busy_ = false;
  std::uint32_t begun_ = 0;  ///< us
};

static_assert(bus::I2cBus<I2c>);

}  // namespace fencepost::mcu::rp2
