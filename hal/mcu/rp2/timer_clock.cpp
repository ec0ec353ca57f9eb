#include "hal/mcu/rp2/timer_clock.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/register.hpp"
#include "hal/mcu/rp2/part.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constexpr std::uint32_t kAlarm = 1U << 0;
constexpr std::uint32_t kMillisecond = 1'000;

// An alarm in the past would come after 71 minutes: from now on, not from the last one on.
void set_alarm() { reg(kTimerAlarm0) = reg(kTimerRawLow) + kMillisecond; }

}  // namespace

void TimerClock::start(std::uint32_t reference_hz) {
  start_microseconds(reference_hz);
  bring_up(kResetTimer);
  reg(kTimerDebugPause) = 0;  // or time stands still after a debugger has left
  reg(kTimerInterruptEnable) = kAlarm;
  cortex_m::enable_interrupt(kInterruptTimer0);
  set_alarm();
}

void TimerClock::tick() {
  reg(kTimerInterrupts) = kAlarm;
  set_alarm();
}

// Again, if the lower half has wrapped in between.
base::Time TimerClock::now() {
  for (;;) {
    const std::uint32_t high = reg(kTimerRawHigh);
    const std::uint32_t low = reg(kTimerRawLow);
    if (reg(kTimerRawHigh) != high) continue;
    if (high == 0) return {low / 100};  // the first 71 minutes need no long division
    return {static_cast<std::int64_t>(((std::uint64_t{high} << 32) | low) / 100)};
  }
}

std::uint32_t TimerClock::microseconds() { return reg(kTimerRawLow); }

}  // namespace fencepost::mcu::rp2
