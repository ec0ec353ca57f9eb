// Reacquisition error: the dissimilarity of a region of a real image and a rendered region. Its terms in decreasing
// importance are hue, colour, width and height, shape, location (paper Fig. 6).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

/// Channels 0 to 255.
struct Colour {
  double red = 0;
  double green = 0;
  double blue = 0;
};
Colour colour_of(sensor::Rgb rgb);

/// A coloured region of one image. Continuous edges, px: pixel u reaches from u - 0.5 to u + 0.5.
struct Region {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  double pixels = 0;             ///< area; 0: not known
  std::uint8_t signature = 0;    ///< compared only where one of two regions has no colour
  std::optional<Colour> colour;  ///< mean of its pixels

  /// At least 1 px, so that every logarithm below is defined.
  [[nodiscard]] double width() const { return right - left > 1 ? right - left : 1; }
  [[nodiscard]] double height() const { return bottom - top > 1 ? bottom - top : 1; }
  /// Share of the box; nothing if the area is not known.
  [[nodiscard]] std::optional<double> fill() const;
};

Region region_of(const sensor::Blob& blob);

/// Each in [0, 1]. `rgb` is nothing where a region has no colour; then the signatures decide `hue`, 0 or 1.
struct ReacquisitionTerms {
  double hue = 0;
  std::optional<double> rgb;
  double width = 0;
  double height = 0;
  double shape = 0;
  double location = 0;
};

/// Sums of weights other than 1 are divided out, so the error stays in [0, 1].
struct ReacquisitionWeights {
  double hue = 0.32;
  double rgb = 0.22;
  double width = 0.11;
  double height = 0.11;
  double shape = 0.10;
  double location = 0.25;
};

/// The fill assumed where a region's area is unknown.
inline constexpr double kUsualFill = 0.92;

/// Hue: 60 degrees are 1; the less saturated of the two is, the more the difference in saturation counts instead.
/// Rgb: a distance of 160 is 1. Width, height, aspect: a factor of four is 1. Fill: a difference of 0.5 is 1.
/// Location: half the rendered width plus 10 px across, or a quarter of the image's width down, is 1.
ReacquisitionTerms reacquisition_terms(const Region& real, const Region& rendered, int image_width);

double reacquisition_error(const ReacquisitionTerms& terms, const ReacquisitionWeights& weights = {});

/// Names and values in the paper's order, for tables.
struct NamedTerm {
  std::string_view name;
  std::optional<double> value;
  double weight = 0;
};
std::array<NamedTerm, 6> named_terms(const ReacquisitionTerms& terms, const ReacquisitionWeights& weights = {});

}  // namespace fencepost::host
