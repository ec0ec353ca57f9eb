#include "hal/mcu/stm32f4/timer_clock.hpp"

#include "hal/mcu/register.hpp"
#include "hal/mcu/stm32f4/clocks.hpp"
#include "hal/mcu/stm32f4/registers.hpp"

namespace fencepost::mcu::stm32f4 {

void TimerClock::start(std::uint32_t timer_hz) {
  enable_clock(kRccApb1Enable, kTimer2Clock);
  reg(kTimer2 + kTimerControl) = 0;
  reg(kTimer2 + kTimerPrescaler) = timer_hz / 1'000'000 - 1;
  reg(kTimer2 + kTimerReload) = 0xFFFF'FFFF;
  reg(kTimer2 + kTimerEvent) = kTimerUpdate;  // the prescaler is taken over
  reg(kTimer2 + kTimerControl) = kTimerEnable;
  low_ = high_ = 0;
}

base::Time TimerClock::now() const {
  const std::uint32_t low = microseconds();
  if (low < low_) ++high_;
  low_ = low;
  if (high_ == 0) return {low / 100};  // the first 71 minutes need no long division
  return {static_cast<std::int64_t>(((std::uint64_t{high_} << 32) | low) / 100)};
}

std::uint32_t TimerClock::microseconds() { return reg(kTimer2 + kTimerCount); }

}  // namespace fencepost::mcu::stm32f4
