// A point of the floor where a foot was seen. It belongs to no object.
#pragma once

#include <cstdint>
#include <limits>

namespace fencepost::recon::guard {

/// Eight bytes. Place in mm from the store's origin, odometry's axes.
struct Front {
  std::int16_t x = 0;
  std::int16_t y = 0;
  std::uint8_t frames =
      0;  ///< a bit for each of the last eight frames, in turn, that supported it: which, not how often
  std::uint8_t doubt = 0;  ///< time for which frames have looked past it, less its support, in kDoubtTicks
  std::uint8_t seen = 0;   ///< when it was supported last, counts of kSeenTicks modulo 256
  std::uint8_t signature = 0;
};
static_assert(sizeof(Front) == 8);

/// How many of the last frames a point remembers. Derived: the bits of Front::frames.
inline constexpr unsigned kRememberedFrames = std::numeric_limits<decltype(Front::frames)>::digits;

inline constexpr int kDoubtTicks = 32;   ///< unit of Front::doubt, ticks of 0.1 ms
inline constexpr int kSeenTicks = 2048;  ///< unit of Front::seen, ticks of 0.1 ms

/// At least kFewestViews of these eight: it takes three, and counting all of them costs more.
constexpr bool enough_frames(unsigned frames) {
  frames &= frames - 1;
  frames &= frames - 1;
  return frames != 0;
}

}  // namespace fencepost::recon::guard
