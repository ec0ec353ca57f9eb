// How like two colours look, whatever light falls on them.
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

/// A colour as a point: hue is the direction and saturation the length of (x, y), so red has no seam at 360 degrees; z
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

/// Appearances of all colours, computed once each. 8 bits a channel are cut to 6: below what the classes can tell
/// apart.
class AppearanceTable {
 public:
  AppearanceTable();
  [[nodiscard]] std::size_t index(const cv::Vec3b& bgr) const {
    return (std::size_t{bgr[2]} >> 2U << 12U) | (std::size_t{bgr[1]} >> 2U << 6U) | std::size_t{bgr[0]} >> 2U;
  }
  [[nodiscard]] const std::vector<Appearance>& all() const { return all_; }

 private:
  std::vector<Appearance> all_;
};

/// "red", "yellow", "dark grey": what people call it.
std::string colour_name(sensor::Rgb rgb);

}  // namespace fencepost::host
