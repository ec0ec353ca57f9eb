#include "hal/mcu/gba/clock.hpp"

#include "hal/mcu/gba/registers.hpp"
#include "hal/mcu/register.hpp"

namespace fencepost::mcu::gba {
namespace {

constexpr std::uint32_t kCountsPerSecond = kCoreHz / 64;
constexpr std::uint32_t kTickTimer = 2;

void start_timer(std::uint32_t n, std::uint16_t from, std::uint16_t control) {
  reg16(kTimerControl + n * kTimerStride) = 0;
  reg16(kTimerCount + n * kTimerStride) = from;
  reg16(kTimerControl + n * kTimerStride) = static_cast<std::uint16_t>(control | kTimerStart);
}

// Again, if the lower half ran over in between.
std::uint32_t counter() {
  for (;;) {
    const std::uint16_t high = reg16(kTimerCount + kTimerStride);
    const std::uint16_t low = reg16(kTimerCount);
    if (high == reg16(kTimerCount + kTimerStride)) return (std::uint32_t{high} << 16) | low;
  }
}

}  // namespace

void Clock::start() {
  start_timer(1, 0, kTimerCascade);
  start_timer(0, 0, kTimerBy64);
  start_timer(kTickTimer, static_cast<std::uint16_t>(0x1'0000 - kCoreHz / kTicks), kTimerInterrupt);
  reg16(kInterruptEnable) = static_cast<std::uint16_t>(reg16(kInterruptEnable) | kInterruptTimer2);
}

void Clock::tick() {
  const std::uint32_t count = counter();
  if (count < low_) high_ = high_ + 1;
  low_ = count;
  ticks_ = ticks_ + 1;
}

// Adds the counts since the last tick: right even while the tick after an overflow is still to come.
std::uint64_t Clock::counts() const {
  for (;;) {
    const std::uint32_t low = low_;
    const std::uint32_t high = high_;
    const std::uint32_t since = counter() - low;
    if (low == low_) return ((std::uint64_t{high} << 32) | low) + since;
  }
}

base::Time Clock::now() const {
  constexpr std::uint64_t kTimeUnits = 10'000;
  return {static_cast<std::int64_t>(counts() * kTimeUnits / kCountsPerSecond)};
}

std::uint32_t Clock::microseconds() const {
  return static_cast<std::uint32_t>(counts() * 1'000'000 / kCountsPerSecond);
}

}  // namespace fencepost::mcu::gba
