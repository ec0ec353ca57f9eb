#include "hal/mcu/nrf51/timer_clock.hpp"

#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/nrf51/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::nrf51 {
namespace {

constexpr std::uint32_t kMillisecond = 1'000;
constexpr std::uint32_t kAlarm = 0;        // compare register that wakes
constexpr std::uint32_t kOfLoop = 1;       // the one that the loop reads
constexpr std::uint32_t kOfInterrupt = 2;  // the one that the interrupt reads

std::uint32_t capture(std::uint32_t n) {
  reg(kTimerCapture + 4 * n) = kTrigger;
  return reg(kTimerCompare + 4 * n);
}

}  // namespace

void TimerClock::start() {
  reg(kTimerBits) = kTimer32Bits;
  reg(kTimerPrescaler) = kTimer1MHz;
  reg(kTimerCompare + 4 * kAlarm) = kMillisecond;
  reg(kTimerInterrupts) = kTimerReached0Interrupt;
  cortex_m::enable_interrupt(interrupt_of(kTimer));
  reg(kTimerStart) = kTrigger;
}

// Until the alarm is set to a time that has not passed yet: one that has would come after 71 minutes.
void TimerClock::on_interrupt() {
  reg(kTimerReached + 4 * kAlarm) = 0;
  do {
    count_milliseconds();
    reg(kTimerCompare + 4 * kAlarm) = counted_ + kMillisecond;
  } while (capture(kOfInterrupt) - counted_ >= kMillisecond);
}

void TimerClock::count_milliseconds() {
  const std::uint32_t now = capture(kOfInterrupt);
  std::uint32_t counted = counted_;
  std::uint32_t low = low_;
  while (now - counted >= kMillisecond) {
    counted += kMillisecond;
    if (++low == 0) high_ = high_ + 1;
  }
  low_ = low;
  counted_ = counted;
}

base::Time TimerClock::now() const {
  for (;;) {
    const std::uint32_t high = high_;
    const std::uint32_t low = low_;
    const std::uint32_t since = capture(kOfLoop) - counted_;
    if (low != low_ || high != high_) continue;
    return {static_cast<std::int64_t>(((std::uint64_t{high} << 32) | low) * 10 + since / 100)};
  }
}

std::uint32_t TimerClock::microseconds() const { return capture(kOfLoop); }

}  // namespace fencepost::mcu::nrf51
