// Waiting in tests against a real kernel: as long as it takes, and not for ever.
#pragma once

#include <chrono>
#include <thread>

#include "hal/base/result.hpp"
#include "hal/linux/clock.hpp"

namespace fencepost::guest {

/// Generous: an emulated processor beside a busy build. Only failures take this long.
inline constexpr base::Duration kPatience = base::milliseconds(15'000);

/// Whether `condition` came true in time.
template <class Condition>
bool eventually(Condition condition) {
  const linux::MonotonicClock clock;
  while (!condition()) {
    if (clock.now() > base::Time{} + kPatience) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// The answer of a call, once it is another one than "not ready".
template <class Call>
auto settled(Call call) -> decltype(call()) {
  auto answer = call();
  eventually([&] {
    if (answer.ok() || answer.error() != base::Error::kNotReady) return true;
    answer = call();
    return answer.ok() || answer.error() != base::Error::kNotReady;
  });
  return answer;
}

}  // namespace fencepost::guest
