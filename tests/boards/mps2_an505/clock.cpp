// The part's clock by a counter of microseconds and the core's own tick.
#include "hal/mcu/cortex_m/core.hpp"
#include "hal/mcu/rp2/timer_clock.hpp"
#include "tests/boards/mps2_an386/registers.hpp"

namespace fencepost::mcu::rp2 {
namespace {

constinit std::uint32_t high = 0;  // of the time in microseconds
constinit std::uint32_t last = 0;  // count that was read

}  // namespace

void TimerClock::start(std::uint32_t /*reference_hz*/) {
  reg(test::mps2::kCounterDivider) = test::mps2::kCoreHz / 1'000'000 - 1;
  last = microseconds();
  cortex_m::start_ticks(test::mps2::kCoreHz);
}

// It wraps after 71 minutes, and is read more often.
void TimerClock::tick() {
  const std::uint32_t count = microseconds();
  if (count < last) ++high;
  last = count;
}

base::Time TimerClock::now() {
  const cortex_m::InterruptsHeld held;
  tick();
  return {static_cast<std::int64_t>(((std::uint64_t{high} << 32) | last) / 100)};
}

std::uint32_t TimerClock::microseconds() { return reg(test::mps2::kCounter); }

}  // namespace fencepost::mcu::rp2
