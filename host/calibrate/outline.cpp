#include "host/calibrate/outline.hpp"

#include <cmath>
#include <numbers>

#include "host/calibrate/sighting_model.hpp"

namespace fencepost::host {

LinearRing outline_of(const ObjectValues& object) {
  LinearRing ring;
  constexpr int kCorners = 48;
  for (int i = 0; i < kCorners; ++i) {
    // The point that touches the tangent: support along the normal, its derivative along the tangent.
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const double step = 1e-4;
    const auto reach = [&](double a) { return calibration::support(object.data(), std::cos(a), std::sin(a)); };
    const double h = reach(angle);
    const double slope = (reach(angle + step) - reach(angle - step)) / (2 * step);
    ring.push_back({h * std::cos(angle) - slope * std::sin(angle), h * std::sin(angle) + slope * std::cos(angle)});
  }
  return ring;
}

}  // namespace fencepost::host
