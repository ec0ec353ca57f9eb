#include "hal/mcu/rp2/i2c.hpp"

#include <algorithm>

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/free_wires.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"
#include "hal/mcu/rp2/timer_clock.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constexpr std::uint32_t kHalfPulse = 5;  // us

void pause() {
  const std::uint32_t began = TimerClock::microseconds();
  while (TimerClock::microseconds() - began <= kHalfPulse) {
  }
}

void clear_by_reading(std::uint32_t address) { [[maybe_unused]] const std::uint32_t value = reg(address); }

}  // namespace

void I2c::start(const I2cWiring& wiring, std::uint32_t clock_hz, std::uint32_t bus_hz) {
  wiring_ = wiring;
  clock_hz_ = clock_hz;
  bus_hz_ = bus_hz;
  if (busy_) free_bus();
  set_up();
  cortex_m::enable_interrupt(wiring.interrupt);
}

void I2c::set_up() {
  {
    // The old transfer's interrupt would find nothing to do and come again without end, before the reset and in it.
    const cortex_m::InterruptsHeld held;
    busy_ = false;
    bring_up(wiring_.reset);
  }
  const std::uint32_t period = clock_hz_ / bus_hz_;
  const std::uint32_t low = period * 3 / 5;  // the bus specification wants the low half longer
  reg(wiring_.base + kI2cEnable) = 0;
  reg(wiring_.base + kI2cControl) = kI2cMaster;
  reg(wiring_.base + kI2cHighPeriod) = period - low;
  reg(wiring_.base + kI2cLowPeriod) = low;
  reg(wiring_.base + kI2cSpikeLength) = std::max(low / 16, std::uint32_t{1});
  reg(wiring_.base + kI2cDataHold) = clock_hz_ / 10'000'000 * 3 + 1;  // 300 ns
  reg(wiring_.base + kI2cReceiveThreshold) = 0;
  reg(wiring_.base + kI2cSendThreshold) = kI2cFifo / 4;
  reg(wiring_.base + kI2cInterruptEnable) = 0;
  wiring_.data.connect(kFunctionI2c);
  wiring_.clock.connect(kFunctionI2c);
}

base::Result<std::size_t> I2c::begin(std::uint8_t address, std::span<const std::uint8_t> out, std::size_t expected) {
  if (wiring_.base == 0) return base::Error::kGone;
  if (busy_ || out.size() > bytes_.size() || expected > bytes_.size()) return base::Error::kFull;
  if (out.empty() && expected == 0) return base::Error::kRefused;  // this master has no transfer without a byte
  std::ranges::copy(out, bytes_.begin());
  written_ = out.size();
  expected_ = expected;
  commanded_ = 0;
  read_ = 0;
  stopped_ = false;
  refused_ = false;
  busy_ = true;
  begun_ = TimerClock::microseconds();
  reg(wiring_.base + kI2cEnable) = 0;
  reg(wiring_.base + kI2cTarget) = address;
  reg(wiring_.base + kI2cEnable) = 1;
  clear_by_reading(wiring_.base + kI2cClearInterrupts);
  const cortex_m::InterruptsHeld held;
  command_more();
  return out.size();
}

base::Result<std::size_t> I2c::finish(std::span<std::uint8_t> in) {
  if (wiring_.base == 0) return base::Error::kGone;
  if (!busy_) return base::Error::kNotReady;
  if (!stopped_) {
    if (TimerClock::microseconds() - begun_ < kLongest) return base::Error::kNotReady;
    free_bus();
    set_up();
    return base::Error::kRefused;
  }
  busy_ = false;
  if (refused_) return base::Error::kRefused;
  const std::size_t count = std::min(static_cast<std::size_t>(read_), in.size());
  std::copy_n(bytes_.begin(), count, in.begin());
  return count;
}

void I2c::on_interrupt() {
  if (!busy_) return;
  const std::uint32_t status = reg(wiring_.base + kI2cInterruptStatus);
  while (reg(wiring_.base + kI2cReceiveLevel) > 0) {
    const auto byte = static_cast<std::uint8_t>(reg(wiring_.base + kI2cData) & 0xFF);
    if (read_ < bytes_.size()) bytes_[read_] = byte;
    read_ = read_ + 1;
  }
  if ((status & kI2cAborted) != 0) {
    clear_by_reading(wiring_.base + kI2cClearAbort);
    refused_ = true;
    commanded_ = written_ + expected_;  // the part has discarded its queue
  }
  if ((status & kI2cStopped) != 0) {
    clear_by_reading(wiring_.base + kI2cClearStop);
    stopped_ = true;
    reg(wiring_.base + kI2cInterruptEnable) = 0;
    return;
  }
  command_more();
}

// Commands as much as fits into the part's queue; no more reads than its other queue has room for.
void I2c::command_more() {
  const std::size_t all = written_ + expected_;
  const std::size_t answered = written_ + read_;
  while (commanded_ < all && reg(wiring_.base + kI2cSendLevel) < kI2cFifo &&
         (commanded_ < written_ || commanded_ - answered < kI2cFifo)) {
    const std::size_t n = commanded_++;  // first: the emulator may interrupt at once
    reg(wiring_.base + kI2cData) = command(n);
  }
  const std::uint32_t hungry = commanded_ < written_ ? kI2cSendEmpty : 0;
  reg(wiring_.base + kI2cInterruptEnable) = kI2cReceived | kI2cAborted | kI2cStopped | hungry;
}

std::uint32_t I2c::command(std::size_t n) const {
  const std::uint32_t last = n + 1 == written_ + expected_ ? kI2cStop : 0;
  if (n < written_) return bytes_[n] | last;
  return kI2cRead | last | (n == written_ && written_ > 0 ? kI2cRestart : 0);
}

void I2c::free_bus() const {
  wiring_.clock.take_wire();
  wiring_.data.take_wire();
  free_wires(wiring_.clock, wiring_.data, [] { pause(); });
}

}  // namespace fencepost::mcu::rp2
