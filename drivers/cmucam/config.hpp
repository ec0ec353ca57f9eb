// Configuration of one robot's CMUcam.
#pragma once

#include <cstdint>

#include "drivers/cmucam/dialect.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/units.hpp"

namespace fencepost::cmucam {

/// A window of colours, bounds inclusive, in 0..255; the driver narrows it to what the camera's imager gives.
struct ColourWindow {
  std::uint8_t signature = 0;
  std::uint8_t red_min = 0;
  std::uint8_t red_max = 0;
  std::uint8_t green_min = 0;
  std::uint8_t green_max = 0;
  std::uint8_t blue_min = 0;
  std::uint8_t blue_max = 0;
};

/// The camera has one window at a time: several alternate, and a frame holds one blob of each. Those blobs are then one
/// camera frame apart, which shows while the robot turns; a single window gets the full rate.
inline constexpr std::size_t kMaxWindows = 8;

struct Config {
  const Dialect* dialect = &kCmuCam1;
  base::FixedVector<ColourWindow, kMaxWindows> windows;
  /// White balance and gain run this long before they are frozen; at most a minute.
  base::Duration settle = base::milliseconds(5'000);
  bool raw = true;  ///< raw packets, where the dialect has them; ASCII is twice as long and says the same
};

}  // namespace fencepost::cmucam
