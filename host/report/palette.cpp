#include "host/report/palette.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "host/result/lookup.hpp"

namespace fencepost::host {
namespace {

double linear(double channel) {
  const double c = channel / 255;
  return c <= 0.03928 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double luminance(sensor::Rgb c, double scale) {
  return 0.2126 * linear(c.red * scale) + 0.7152 * linear(c.green * scale) + 0.0722 * linear(c.blue * scale);
}

std::string hex_scaled(sensor::Rgb c, double scale) {
  const auto channel = [&](std::uint8_t v) { return static_cast<int>(v * scale); };
  return fmt::format("#{:02x}{:02x}{:02x}", channel(c.red), channel(c.green), channel(c.blue));
}

}  // namespace

std::string ink(sensor::Rgb colour, double max_luminance) {
  if (luminance(colour, 1) <= max_luminance) return hex(colour);
  double low = 0;
  double high = 1;
  for (int i = 0; i < 20; ++i) {  // 2^-20 is far below one step of a channel
    const double middle = (low + high) / 2;
    (luminance(colour, middle) <= max_luminance ? low : high) = middle;
  }
  return hex_scaled(colour, low);
}

std::string hex(sensor::Rgb colour) { return hex_scaled(colour, 1); }

sensor::Rgb signature_colour(const ResultDocument& document, std::uint8_t signature) {
  if (const record::Signature* entry = find_signature(document, signature)) return entry->rgb;
  // Okabe and Ito's colours, distinguishable with every common kind of colour vision.
  constexpr std::array<sensor::Rgb, 7> kOwn = {{{0xD5, 0x5E, 0x00},
                                                {0x00, 0x72, 0xB2},
                                                {0x00, 0x9E, 0x73},
                                                {0xCC, 0x79, 0xA7},
                                                {0xE6, 0x9F, 0x00},
                                                {0x56, 0xB4, 0xE9},
                                                {0x60, 0x60, 0x60}}};
  return kOwn[signature % kOwn.size()];
}

ModelStyle model_style(const std::string& name) {
  static const std::array<std::pair<const char*, ModelStyle>, 9> kStyles = {{
      {"clip", {"", 1.4, 0.22, 0}},
      {"carve", {"1.5 2.5", 1.4, 0.08, 1}},
      {"clip_paper", {"4 2", 1.2, 0, 0, false}},  // as printed one wrong wedge leaves nothing
      {"carve_paper", {"1 3", 1.2, 0, 1, false}},
      {"sheaf", {"10 3 2 3", 1.6, 0, 2}},
      {"sheaf_paper", {"2 4", 1.2, 0, 2, false}},  // as printed it reaches to the robot's own path
      {"cylinder_paper", {"6 4", 1.6, 0, 3}},
      {"cylinder", {"", 2.2, 0, 4}},
      {"hybrid", {"", 3.2, 0.12, 5}},
  }};
  for (const auto& [known, style] : kStyles) {
    if (name == known) return style;
  }
  return {"3 3", 1.6, 0, 2};
}

std::string level_colour(record::AlertLevel level) {
  switch (level) {
    case record::AlertLevel::kClear: return "#e9edf1";
    case record::AlertLevel::kNotice: return "#f6d365";
    case record::AlertLevel::kWarn: return "#e8871e";
    case record::AlertLevel::kStop: return "#b1122a";
    case record::AlertLevel::kBlind: return "#5b2a86";
  }
  return "#e9edf1";
}

}  // namespace fencepost::host
