#include "drivers/segmenter/colour_table.hpp"

#include <algorithm>

#include "hal/base/check.hpp"

namespace fencepost::segmenter {
namespace {

using bus::PixelLayout;

/// Of half a grey level, 0 to 510: the middle of an even number of levels is one.
struct Colour {
  std::int32_t red = 0;
  std::int32_t green = 0;
  std::int32_t blue = 0;
};
constexpr std::int32_t kBrightest = 510;

struct Nearness {
  std::int64_t off = 0;  ///< from the middle of a range
  std::int64_t half = 1;
};

/// Of a share `part / sum`, in units of 10^-4.
Nearness nearness(std::int64_t part, std::int64_t sum, base::Ratio4 low, base::Ratio4 high) {
  const std::int64_t off = 2 * part * base::Ratio4::kPerUnit - (low.raw + high.raw) * sum;
  // A range of a single value has a width too, or it were infinitely far from itself.
  return {off < 0 ? -off : off, (high.raw - low.raw + 1) * sum};
}

bool is_nearer(const Nearness& a, const Nearness& b) { return a.off * b.half < b.off * a.half; }

/// Whether the colour is in the range, and where: the farther of both shares.
bool find_in(const ColourRange& range, const Colour& colour, Nearness& where) {
  const std::int64_t sum = colour.red + colour.green + colour.blue;
  const auto within = [&](std::int64_t part, base::Ratio4 low, base::Ratio4 high) {
    return part * base::Ratio4::kPerUnit >= low.raw * sum && part * base::Ratio4::kPerUnit <= high.raw * sum;
  };
  if (sum < 6 * range.brightness_min || sum > 6 * range.brightness_max + 5 || sum == 0) return false;
  if (!within(colour.red, range.red_min, range.red_max)) return false;
  if (!within(colour.green, range.green_min, range.green_max)) return false;
  const Nearness red = nearness(colour.red, sum, range.red_min, range.red_max);
  const Nearness green = nearness(colour.green, sum, range.green_min, range.green_max);
  where = is_nearer(red, green) ? green : red;
  return true;
}

std::uint8_t signature_of_halves(std::span<const ColourRange> ranges, const Colour& colour) {
  std::uint8_t signature = 0;
  Nearness nearest;
  for (const ColourRange& range : ranges) {
    Nearness where;
    if (!find_in(range, colour, where)) continue;
    if (signature != 0 && !is_nearer(where, nearest)) continue;
    nearest = where;
    signature = range.signature;
  }
  return signature;
}

/// ITU-R BT.601, coefficients in 1/1024; all in half levels, chroma around 0.
Colour from_yuv(std::int32_t luma, std::int32_t u, std::int32_t v, bool full) {
  if (!full) {
    luma = (luma - 32) * 255 / 219;
    u = u * 255 / 224;
    v = v * 255 / 224;
  }
  const auto level = [](std::int32_t value) { return std::clamp(value, std::int32_t{0}, kBrightest); };
  return {level(luma + 1436 * v / 1024), level(luma - (352 * u + 731 * v) / 1024), level(luma + 1815 * u / 1024)};
}

/// The middle of the step in which the bits lie, in half levels.
constexpr std::int32_t middle(std::size_t index, unsigned shift, unsigned bits) {
  const std::size_t step = (index >> shift) & ((std::size_t{1} << bits) - 1);
  const std::size_t size = std::size_t{256} >> bits;
  return static_cast<std::int32_t>(2 * step * size + size - 1);
}

constexpr unsigned kFirst = 11;  ///< shift of six bits of U or red in an index
constexpr unsigned kSecond = 5;  ///< shift of six bits of V or green; the last five are of Y or blue

Colour colour_of(std::size_t index, PixelLayout layout) {
  const std::int32_t a = middle(index, kFirst, 6);
  const std::int32_t b = middle(index, kSecond, 6);
  const std::int32_t c = middle(index, 0, 5);
  if (layout == PixelLayout::kRgb) return {a, b, c};
  return from_yuv(c, a - 256, b - 256, layout == PixelLayout::kYuyvFull);
}

}  // namespace

std::uint8_t signature_of(std::span<const ColourRange> ranges, int red, int green, int blue) {
  return signature_of_halves(ranges, {2 * red, 2 * green, 2 * blue});
}

void ColourTable::fill(PixelLayout layout, std::span<const ColourRange> ranges) {
  layout_ = layout;
  for (std::size_t i = 0; i < kEntries; ++i) table_[i] = signature_of_halves(ranges, colour_of(i, layout));
}

void ColourTable::look_up(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const {
  FENCEPOST_CHECK(row.size() >= row_bytes(layout_, labels.size()));
  layout_ == PixelLayout::kRgb ? look_up_rgb(row, labels) : look_up_yuyv(row, labels);
}

void ColourTable::look_up_yuyv(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const {
  const std::uint8_t* pixels = row.data();
  const std::size_t size = labels.size();
  for (std::size_t i = 0; i < size; i += 2, pixels += 4) {
    // Lumas of one chroma are neighbours in the table: 32 bytes.
    const std::size_t chroma = (std::size_t{pixels[1]} >> 2U) << kFirst | (std::size_t{pixels[3]} >> 2U) << kSecond;
    labels[i] = table_[chroma | pixels[0] >> 3U];
    if (i + 1 < size) labels[i + 1] = table_[chroma | pixels[2] >> 3U];
  }
}

void ColourTable::look_up_rgb(std::span<const std::uint8_t> row, std::span<std::uint8_t> labels) const {
  const std::uint8_t* pixel = row.data();
  for (std::uint8_t& label : labels) {
    label = table_[(std::size_t{pixel[0]} >> 2U) << kFirst | (std::size_t{pixel[1]} >> 2U) << kSecond | pixel[2] >> 3U];
    pixel += 3;
  }
}

}  // namespace fencepost::segmenter
