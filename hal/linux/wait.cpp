#include "hal/linux/wait.hpp"

#include <ctime>

namespace fencepost::linux {
namespace {

timespec as_timespec(base::Duration duration) {
  const std::int64_t ticks = duration.raw < 0 ? 0 : duration.raw;
  constexpr std::int64_t kTickNs = 1'000'000'000 / base::Duration::kPerUnit;
  return {ticks / base::Duration::kPerUnit, static_cast<long>(ticks % base::Duration::kPerUnit * kTickNs)};
}

}  // namespace

bool WaitSet::wait_until(const MonotonicClock& clock, base::Time deadline) {
  const timespec remaining = as_timespec(deadline - clock.now());
  return ::ppoll(watched_.data(), watched_.size(), &remaining, nullptr) > 0;
}

}  // namespace fencepost::linux
