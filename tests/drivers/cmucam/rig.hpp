// A driver, a wire and an emulated CMUcam, moved together by 2 ms steps.
#pragma once

#include <optional>
#include <vector>

#include "drivers/cmucam/cmucam.hpp"
#include "hal/fake/stepped_clock.hpp"
#include "host/emulate/cmucam.hpp"
#include "tests/drivers/wire.hpp"

namespace fencepost::cmucam {

struct Rig {
  static constexpr base::Duration kStep = base::milliseconds(2);
  static constexpr std::int64_t kStepsAFrame = 30;  ///< 16.7 /s

  Rig(const Config& config, emulate::CmuCamModel model, std::uint64_t seed = 1)
      : wire(seed), device(model), driver(wire, config) {
    wire.from_device(device.power_up());
  }

  /// One step; a frame if one is complete.
  std::optional<sensor::BlobFrame> step() {
    clock.advance(kStep);
    ++steps;
    if (powered) {
      wire.from_device(device.feed(wire.to_device()));
      if (steps % kStepsAFrame == 0) wire.from_device(device.frame(spots));
    } else {
      (void)wire.to_device();
    }
    const base::Result<sensor::BlobFrame> frame = driver.poll(clock.now());
    if (!frame) return std::nullopt;
    return *frame;
  }
  std::vector<sensor::BlobFrame> run(base::Duration time) {
    std::vector<sensor::BlobFrame> frames;
    for (const base::Time end = clock.now() + time; clock.now() < end;) {
      if (const auto frame = step()) frames.push_back(*frame);
    }
    return frames;
  }
  void switch_off() { powered = false; }
  void switch_on() {
    powered = true;
    wire.from_device(device.power_up());
  }

  fake::SteppedClock clock;
  serial::Wire wire;
  emulate::CmuCamDevice device;
  CmuCam<serial::Wire> driver;
  std::vector<emulate::ColouredSpot> spots;
  bool powered = true;
  std::int64_t steps = 0;
};

inline Config two_windows(const Dialect& dialect) {
  Config config;
  config.dialect = &dialect;
  config.settle = base::milliseconds(500);
  (void)config.windows.push_back({1, 180, 240, 16, 60, 16, 60});
  (void)config.windows.push_back({2, 16, 60, 16, 60, 180, 240});
  return config;
}

/// A red and a blue thing.
inline std::vector<emulate::ColouredSpot> red_and_blue() {
  return {{200, 30, 30, 20, 40, 29, 59, 150}, {30, 30, 200, 50, 60, 59, 89, 240}};
}

}  // namespace fencepost::cmucam
