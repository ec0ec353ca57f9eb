// Views with exact, sub-pixel edges, fed to the models behind the stream: no pixels, no quantised poses.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "firmware/recon/observe/sighting.hpp"
#include "host/geometry/half_planes.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::test {

/// An unoccluded view of a footprint, in double and as the sighting that the robot's code gets.
struct ExactView {
  host::Wedge wedge;
  recon::Sighting sighting;
};

inline recon::Vec2 unit(double angle) {
  return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

/// `right`, `left`: bearings of the two edges, rad, map frame.
inline ExactView view_between(host::Point lens, double right, double left) {
  ExactView view;
  view.wedge = {lens, right, left};
  recon::Sighting& s = view.sighting;
  s.lens = {static_cast<float>(lens.x), static_cast<float>(lens.y)};
  s.axis = s.center = unit((right + left) / 2);
  s.left = {unit(left), recon::End::kSeen};
  s.right = {unit(right), recon::End::kSeen};
  s.focal = 273.6F;
  s.lens_height = 0.12F;
  return view;
}

inline ExactView view_of(const host::LinearRing& footprint, host::Point lens) {
  const double toward = std::atan2(footprint[0].y - lens.y, footprint[0].x - lens.x);
  double low = 0;
  double high = 0;
  for (const host::Point& p : footprint) {
    double off = std::atan2(p.y - lens.y, p.x - lens.x) - toward;
    while (off > std::numbers::pi) off -= 2 * std::numbers::pi;
    while (off < -std::numbers::pi) off += 2 * std::numbers::pi;
    low = std::min(low, off);
    high = std::max(high, off);
  }
  return view_between(lens, toward + low, toward + high);
}

inline ExactView view_of_circle(host::Point center, double radius, host::Point lens) {
  const double toward = std::atan2(center.y - lens.y, center.x - lens.x);
  const double half = std::asin(radius / std::hypot(center.x - lens.x, center.y - lens.y));
  return view_between(lens, toward - half, toward + half);
}

/// The paper's tour: `views` lens positions evenly spread over 270 degrees around `center`.
inline std::vector<host::Point> arc(host::Point center, double radius, int views) {
  std::vector<host::Point> lenses;
  for (int i = 0; i < views; ++i) {
    const double angle = 0.3 + 1.5 * std::numbers::pi * i / (views - 1);
    lenses.push_back({center.x + radius * std::cos(angle), center.y + radius * std::sin(angle)});
  }
  return lenses;
}

}  // namespace fencepost::test
