// A camera that delivers whole pictures: a webcam, a film.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/result.hpp"
#include "hal/base/units.hpp"

namespace fencepost::bus {

/// How a row holds its pixels. Luma and chroma are those of ITU-R BT.601.
enum class PixelLayout : std::uint8_t {
  kYuyv,      ///< Y U Y V for two pixels, luma 16 to 235: webcams
  kYuyvFull,  ///< the same with luma 0 to 255
  kRgb,       ///< red, green, blue
};

/// Rows from the top. The bytes are borrowed until the next call of the source.
struct Picture {
  PixelLayout layout = PixelLayout::kYuyv;
  std::uint16_t width = 0;   ///< px
  std::uint16_t height = 0;  ///< px
  std::size_t stride = 0;    ///< bytes from row to row
  std::span<const std::uint8_t> bytes;
  base::Time t;  ///< arrival
};

/// `next()` never waits. It answers the newest picture that was not given yet, or kNotReady. errors: kBadInput: a
/// picture that cannot be decoded; kGone: the camera is missing.
template <class T>
concept PictureSource = requires(T source) {
  { source.next() } -> std::same_as<base::Result<Picture>>;
};

}  // namespace fencepost::bus
