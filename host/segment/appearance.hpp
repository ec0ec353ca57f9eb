// Similarity of two colours under changing light.
#pragma once

#include <string>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

/// A colour as a point: hue is the direction and saturation the length of (x, y), so red has no seam at 360 degrees. z
/// is brightness, which counts for greys and little for strong colours: a block's lit and shaded sides are neighbours.
/// Length 0..0.8 in the plane, z 0..0.8.
struct Appearance {
  double x = 0;
  double y = 0;
  double z = 0;
};

Appearance appearance(sensor::Rgb rgb);

double squared_distance(const Appearance& a, const Appearance& b);
/// Without brightness.
double squared_hue_distance(const Appearance& a, const Appearance& b);

/// Colours no farther apart than this are one colour class.
inline constexpr double kSameColour = 0.15;

/// "red", "yellow", "dark grey": what people call it.
std::string colour_name(sensor::Rgb rgb);

}  // namespace fencepost::host
