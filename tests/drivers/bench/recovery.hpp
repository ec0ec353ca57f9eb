// How long a driver needs after a silence of its device, on a good cable.
#pragma once

#include <algorithm>
#include <memory>

#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

template <class Rig>
class Silences {
 public:
  explicit Silences(base::Duration step) : bench_(Damage{}), step_(step) { bench_.moving = true; }

  /// Each kind of silence at many phases of the conversation, and of several lengths.
  Recovery measure() {
    Recovery worst;
    (void)until_right(kPatience);
    for (int round = 0; round < kRounds; ++round) {
      for (const std::int64_t length : {30, 250, 700, 1'900, 6'100}) {
        calm(round);
        bench_.link.stall();
        pass(base::milliseconds(length));
        // What it said meanwhile is lost: how long a buffer of that needs is not the driver's affair.
        if constexpr (requires { bench_.link.forget(); }) bench_.link.forget();
        bench_.link.resume();
        worst.stall = std::max(worst.stall, until_right(kPatience));
        calm(round);
        bench_.link.unplug();
        pass(base::milliseconds(length));
        bench_.link.replug();
        worst.unplug = std::max(worst.unplug, until_right(kPatience));
      }
      calm(round);
      bench_.restart(bench_.clock.now());
      worst.power = std::max(worst.power, until_right(kPatience));
    }
    return worst;
  }

 private:
  static constexpr int kRounds = 24;
  static constexpr base::Duration kPatience = base::milliseconds(60'000);

  /// Another phase each time: of no device's period a multiple.
  void calm(int round) { pass(base::milliseconds(2'000 + 37 * round)); }
  void pass(base::Duration time) {
    for (const base::Time end = bench_.clock.now() + time; bench_.clock.now() < end;) (void)bench_.step(step_);
  }
  /// Until a sample says what the device says now.
  base::Duration until_right(base::Duration most) {
    const base::Time begin = bench_.clock.now();
    while (bench_.clock.now() - begin < most) {
      const auto sample = bench_.step(step_);
      if (sample && bench_.right(*sample)) break;
    }
    return bench_.clock.now() - begin;
  }

  Bench<Rig> bench_;
  base::Duration step_;
};

template <class Rig>
Recovery measure_recovery(base::Duration step) {
  return std::make_unique<Silences<Rig>>(step)->measure();
}

}  // namespace fencepost::test
