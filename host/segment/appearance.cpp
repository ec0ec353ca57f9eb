#include "host/segment/appearance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fencepost::host {

namespace {

double square(double value) { return value * value; }

double hue_degrees(sensor::Rgb rgb) {
  const double alpha = rgb.red - (rgb.green + rgb.blue) / 2.0;
  const double beta = std::numbers::sqrt3 / 2 * (rgb.green - rgb.blue);
  const double angle = std::atan2(beta, alpha) * 180 / std::numbers::pi;
  return angle < 0 ? angle + 360 : angle;
}

}  // namespace

Appearance appearance(sensor::Rgb rgb) {
  constexpr double kDark = 0.1;  // brightness below which a colour is indistinguishable from noise
  constexpr double kHalfStrong =
      0.25;  // saturation at which a colour counts half: greys are split finely, paints coarsely
  constexpr double kBrightness = 0.8;
  const double most = std::max({rgb.red, rgb.green, rgb.blue}) / 255.0;
  const double least = std::min({rgb.red, rgb.green, rgb.blue}) / 255.0;
  if (most == 0) return {};
  const double saturation = (most - least) / most * square(most) / (square(most) + square(kDark));
  const double strength = square(saturation) / (square(saturation) + square(kHalfStrong));
  const double alpha = rgb.red - (rgb.green + rgb.blue) / 2.0;
  const double beta = std::numbers::sqrt3 / 2 * (rgb.green - rgb.blue);
  const double length = std::sqrt(alpha * alpha + beta * beta);
  const double z = kBrightness * (1 - strength) * most;
  if (length == 0) return {0, 0, z};
  return {strength * alpha / length, strength * beta / length, z};
}

double squared_hue_distance(const Appearance& a, const Appearance& b) { return square(a.x - b.x) + square(a.y - b.y); }

double squared_distance(const Appearance& a, const Appearance& b) {
  return squared_hue_distance(a, b) + square(a.z - b.z);
}

std::string colour_name(sensor::Rgb rgb) {
  struct Span {
    double end;  // degrees
    const char* name;
  };
  constexpr Span kSpans[] = {{15, "red"},   {40, "orange"},  {70, "yellow"}, {165, "green"}, {200, "cyan"},
                             {260, "blue"}, {290, "purple"}, {345, "pink"},  {361, "red"}};
  constexpr double kGrey = 0.4;    // saturation against brightness, as above
  constexpr double kBlack = 0.25;  // of full brightness
  constexpr double kWhite = 0.8;
  const Appearance looks = appearance(rgb);
  const double most = std::max({rgb.red, rgb.green, rgb.blue}) / 255.0;
  if (std::sqrt(square(looks.x) + square(looks.y)) < kGrey) {
    return most < kBlack ? "black" : most > kWhite ? "white" : "grey";
  }
  const double hue = hue_degrees(rgb);
  return std::find_if(std::begin(kSpans), std::end(kSpans), [&](const Span& span) { return hue < span.end; })->name;
}

}  // namespace fencepost::host
