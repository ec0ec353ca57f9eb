// A line that carries nothing but noise: a wrong baud rate, a loose ground, another device.
#pragma once

#include <memory>
#include <optional>
#include <random>
#include <vector>

#include "tests/drivers/bench/bench.hpp"
#include "tests/drivers/bench/hostile_cases.hpp"
#include "tests/drivers/bench/plug.hpp"

namespace fencepost::test {

/// Two minutes of random bytes, as fast as the line is; the device is off. Nothing where a cable carries no single
/// bytes.
template <class Rig>
std::optional<Noise> hear_noise(base::Duration step) {
  const auto bench = std::make_unique<Bench<Rig>>(Damage{});
  if constexpr (requires { bench->link.noise({}), bench->link.power(false); }) {
    constexpr base::Duration kTime = base::milliseconds(120'000);
    constexpr std::size_t kAhead = 64;  // bytes that wait for the driver
    std::mt19937 random(11);
    Noise heard;
    bench->link.power(false);
    for (const base::Time end = bench->clock.now() + kTime; bench->clock.now() < end;) {
      std::vector<std::uint8_t> bytes;
      while (bench->link.waiting() + bytes.size() < kAhead) bytes.push_back(static_cast<std::uint8_t>(random()));
      heard.bytes += bytes.size();
      bench->link.noise(bytes);
      heard.samples += bench->step(step) ? 1U : 0U;
      ++heard.polls;
      heard.working += sensor::works(bench->driver.link()) ? 1U : 0U;
    }
    return heard;
  } else {
    return std::nullopt;
  }
}

}  // namespace fencepost::test
