// The micro:bit's clock by a counter of microseconds and the core's own tick.
#include "hal/mcu/nrf51/timer_clock.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "tests/boards/mps2_an386/registers.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

constexpr std::uint32_t kMillisecond = 1'000;

std::uint32_t counted_now() { return reg(test::mps2::kCounter); }

}  // namespace

void TimerClock::start() {
  reg(test::mps2::kCounterDivider) = test::mps2::kCoreHz / 1'000'000 - 1;
  counted_ = counted_now();
  cortex_m::start_ticks(test::mps2::kCoreHz);
}

void TimerClock::on_interrupt() { count_milliseconds(); }

void TimerClock::count_milliseconds() {
  const std::uint32_t now = counted_now();
  std::uint32_t counted = counted_;
  while (now - counted >= kMillisecond) {
    counted += kMillisecond;
    low_ = low_ + 1;
    if (low_ == 0) high_ = high_ + 1;
  }
  counted_ = counted;
}

base::Time TimerClock::now() const {
  const cortex_m::InterruptsHeld held;
  const std::uint64_t milliseconds = (std::uint64_t{high_} << 32) | low_;
  return {static_cast<std::int64_t>(milliseconds * 10 + (counted_now() - counted_) / 100)};
}

std::uint32_t TimerClock::microseconds() const { return counted_now(); }

}  // namespace fencepost::mcu::nrf51
