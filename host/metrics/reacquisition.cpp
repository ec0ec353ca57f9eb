#include "host/metrics/reacquisition.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::host {
namespace {

double share(double value, double full) { return std::clamp(std::abs(value) / full, 0.0, 1.0); }

double log_ratio(double a, double b) { return share(std::log(a / b), std::log(4.0)); }

struct HueSaturation {
  double hue = 0;  ///< degrees
  double saturation = 0;
};

HueSaturation hue_of(const Colour& c) {
  const double most = std::max({c.red, c.green, c.blue});
  const double spread = most - std::min({c.red, c.green, c.blue});
  const double saturation = most > 1 ? spread / most : 0;
  if (spread < 1e-6) return {0, saturation};
  double sextant = 0;
  if (most == c.red) {
    sextant = std::fmod((c.green - c.blue) / spread + 6, 6.0);
  } else if (most == c.green) {
    sextant = (c.blue - c.red) / spread + 2;
  } else {
    sextant = (c.red - c.green) / spread + 4;
  }
  return {60 * sextant, saturation};
}

double hue_term(const Colour& a, const Colour& b) {
  const HueSaturation one = hue_of(a);
  const HueSaturation other = hue_of(b);
  const double apart = std::abs(one.hue - other.hue);
  const double coloured = share(std::min(one.saturation, other.saturation), 0.25);
  return share(std::min(apart, 360 - apart), 60) * coloured +
         share(one.saturation - other.saturation, 0.5) * (1 - coloured);
}

double rgb_term(const Colour& a, const Colour& b) {
  return share(std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue), 160);
}

double shape_term(const Region& real, const Region& rendered) {
  const double aspect = log_ratio(real.width() / real.height(), rendered.width() / rendered.height());
  if (!real.fill()) return aspect;
  return 0.5 * aspect + 0.5 * share(*real.fill() - rendered.fill().value_or(kUsualFill), 0.5);
}

double location_term(const Region& real, const Region& rendered, int image_width) {
  const double across = (real.left + real.right - rendered.left - rendered.right) / 2;
  const double down = (real.top + real.bottom - rendered.top - rendered.bottom) / 2;
  return 0.7 * share(across, 0.5 * rendered.width() + 10) + 0.3 * share(down, image_width / 4.0);
}

}  // namespace

Colour colour_of(sensor::Rgb rgb) {
  return {static_cast<double>(rgb.red), static_cast<double>(rgb.green), static_cast<double>(rgb.blue)};
}

std::optional<double> Region::fill() const {
  if (!(pixels > 0)) return std::nullopt;
  return pixels / (width() * height());
}

Region region_of(const sensor::Blob& blob) {
  Region region{blob.x1 - 0.5,  blob.y1 - 0.5, blob.x2 + 0.5, blob.y2 + 0.5, static_cast<double>(blob.pixels),
                blob.signature, std::nullopt};
  if (blob.rgb) region.colour = colour_of(*blob.rgb);
  return region;
}

ReacquisitionTerms reacquisition_terms(const Region& real, const Region& rendered, int image_width) {
  ReacquisitionTerms terms;
  if (real.colour && rendered.colour) {
    terms.hue = hue_term(*real.colour, *rendered.colour);
    terms.rgb = rgb_term(*real.colour, *rendered.colour);
  } else {
    terms.hue = real.signature == rendered.signature ? 0 : 1;
  }
  terms.width = log_ratio(real.width(), rendered.width());
  terms.height = log_ratio(real.height(), rendered.height());
  terms.shape = shape_term(real, rendered);
  terms.location = location_term(real, rendered, image_width);
  return terms;
}

double reacquisition_error(const ReacquisitionTerms& terms, const ReacquisitionWeights& weights) {
  double sum = 0;
  double all = 0;
  for (const NamedTerm& term : named_terms(terms, weights)) {
    if (!term.value) continue;
    sum += term.weight * *term.value;
    all += term.weight;
  }
  return all > 0 ? sum / all : 0;
}

std::array<NamedTerm, 6> named_terms(const ReacquisitionTerms& terms, const ReacquisitionWeights& weights) {
  return {{{"hue", terms.hue, weights.hue},
           {"rgb", terms.rgb, weights.rgb},
           {"width", terms.width, weights.width},
           {"height", terms.height, weights.height},
           {"shape", terms.shape, weights.shape},
           {"location", terms.location, weights.location}}};
}

}  // namespace fencepost::host
