#include "hal/linux/clock.hpp"

#include <ctime>

namespace fencepost::linux {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kNanosecondsPerTick = kNanosecondsPerSecond / base::Time::kPerUnit;

std::int64_t nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNanosecondsPerSecond + now.tv_nsec;
}

}  // namespace

MonotonicClock::MonotonicClock() : zero_ns_(nanoseconds()) {}

base::Time MonotonicClock::now() const { return {(nanoseconds() - zero_ns_) / kNanosecondsPerTick}; }

}  // namespace fencepost::linux
