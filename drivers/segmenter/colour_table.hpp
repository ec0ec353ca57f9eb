// The signature of a pixel, looked up by its colour.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "hal/base/units.hpp"
#include "hal/bus/picture_source.hpp"

namespace fencepost::segmenter {

/// The colours of one signature. Red and green are shares of red + green + blue (rg chromaticity): more or less light
/// leaves them as they are. Bounds inclusive.
struct ColourRange {
  std::uint8_t signature = 0;  ///< 1 to 255
  base::Ratio4 red_min;
  base::Ratio4 red_max;
  base::Ratio4 green_min;
  base::Ratio4 green_max;
  /// Mean of red, green and blue, 0 to 255. Shares of dark pixels are noise.
  std::uint8_t brightness_min = 0;
  std::uint8_t brightness_max = 255;
  friend constexpr bool operator==(const ColourRange&, const ColourRange&) = default;
};

/// 0 is background. A colour in several ranges has the signature of the range whose middle is nearest, in widths of
/// that range; of equals, the first.
std::uint8_t signature_of(std::span<const ColourRange> ranges, int red, int green, int blue);

/// 128 KiB: a byte for each colour in steps of 8 (luma, blue) and 4 (the other two) of 256.
class ColourTable {
 public:
  /// Pixels with this layout can be looked up then. Cost: about 10 ms for 8 ranges on a core of 2 GHz.
  void fill(bus::PixelLayout layout, std::span<const ColourRange> ranges);
  [[nodiscard]] bus::PixelLayout layout() const { return layout_; }

  /// The signatures of `labels.size()` pixels. `row`: at least row_bytes() of them.
  void look_up(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const;

 private:
  void look_up_yuyv(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const;
  void look_up_rgb(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const;

  static constexpr std::size_t kEntries = std::size_t{1} << 17U;
  bus::PixelLayout layout_ = bus::PixelLayout::kYuyv;
  std::array<std::uint8_t, kEntries> table_{};
};

/// Bytes of a row that has `pixels` pixels.
constexpr std::size_t row_bytes(bus::PixelLayout layout, std::size_t pixels) {
  return layout == bus::PixelLayout::kRgb ? 3 * pixels : (pixels + 1) / 2 * 4;
}

}  // namespace fencepost::segmenter
