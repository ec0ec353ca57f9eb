#include "hal/mcu/cortex_m/systick_clock.hpp"

#include "hal/mcu/cortex_m/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::cortex_m {

void SysTickClock::start(std::uint32_t core_hz) {
  cycles_ = core_hz / 1000;
  reg(kSysTickReload) = cycles_ - 1;
  reg(kSysTickCurrent) = 0;
  reg(kSysTickControl) = kSysTickEnable | kSysTickInterrupt | kSysTickCoreClock;
}

void SysTickClock::tick() {
  const std::uint32_t next = low_ + 1;
  if (next == 0) high_ = high_ + 1;
  low_ = next;
}

// The counter may have wrapped while the interrupt that counts the wrap is still pending: it is counted here, or time
// would go back. Repeated if the interrupt came in between.
SysTickClock::Reading SysTickClock::read() const {
  for (;;) {
    const std::uint32_t high = high_;
    const std::uint32_t low = low_;
    std::uint32_t left = reg(kSysTickCurrent);
    const bool over = (reg(kInterruptControl) & kSysTickPending) != 0;
    if (over) left = reg(kSysTickCurrent);
    if (low != low_ || high != high_) continue;
    return {((std::uint64_t{high} << 32) | low) + (over ? 1U : 0U), cycles_ - 1 - left};
  }
}

base::Time SysTickClock::now() const {
  const Reading at = read();
  return {static_cast<std::int64_t>(at.milliseconds * 10 + at.cycles * 10 / cycles_)};
}

std::uint32_t SysTickClock::microseconds() const {
  const Reading at = read();
  return static_cast<std::uint32_t>(at.milliseconds) * 1000 + at.cycles / (cycles_ / 1000);
}

}  // namespace fencepost::mcu::cortex_m
