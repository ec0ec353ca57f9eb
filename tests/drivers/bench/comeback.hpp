// A stall, an unplug and a power cycle, one after the other, on a good cable.
#pragma once

#include <memory>

#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

template <class Rig>
class Day {
 public:
  explicit Day(base::Duration step) : bench_(Damage{}), step_(step) { bench_.moving = true; }

  Comeback spend() {
    Comeback day;
    bench_.link.stall();
    (void)pass(kDead);
    day.before = bench_.driver.link();
    bench_.link.resume();
    (void)pass(kRecovery);
    day.working = bench_.driver.link();
    bench_.link.stall();
    (void)pass(kDead);
    day.stalled = bench_.driver.link();
    bench_.link.resume();
    (void)pass(kRecovery);
    day.after_stall = bench_.driver.link();
    bench_.link.unplug();
    (void)pass(base::milliseconds(1'500));
    day.unplugged = bench_.driver.link();
    bench_.link.replug();
    (void)pass(kRecovery);
    day.replugged = bench_.driver.link();
    bench_.restart(bench_.clock.now());
    (void)pass(kRecovery);
    day.samples_after_power_cycle = pass(base::milliseconds(2'000));
    day.after_power_cycle = bench_.driver.link();
    day.wrong = wrong_;
    return day;
  }

 private:
  static constexpr base::Duration kDead = base::milliseconds(10'000);
  static constexpr base::Duration kRecovery = base::milliseconds(15'000);

  std::uint64_t pass(base::Duration time) {
    std::uint64_t samples = 0;
    for (const base::Time end = bench_.clock.now() + time; bench_.clock.now() < end;) {
      const auto sample = bench_.step(step_);
      if (!sample) continue;
      ++samples;
      wrong_ += bench_.right(*sample) || bench_.old(*sample) ? 0U : 1U;
    }
    return samples;
  }

  Bench<Rig> bench_;
  base::Duration step_;
  std::uint64_t wrong_ = 0;
};

template <class Rig>
Comeback spend_day(base::Duration step) {
  return std::make_unique<Day<Rig>>(step)->spend();
}

}  // namespace fencepost::test
