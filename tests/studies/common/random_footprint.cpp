#include "tests/studies/common/random_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/geometry/rings.hpp"

namespace fencepost::test {

host::LinearRing random_footprint(Dice& dice) {
  const double size = dice.between(0.06, 0.26);
  const double a = size / 2;
  switch (dice.below(4)) {
    case 0: {
      const double b = a * dice.between(0.4, 1);
      return {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
    }
    case 1: {
      host::LinearRing ring;
      for (int i = 0; i < 3; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3 + dice.between(-0.25, 0.25);
        ring.push_back({size / 1.8 * std::cos(angle), size / 1.8 * std::sin(angle)});
      }
      return ring;
    }
    case 2: return host::circle_ring({0, 0}, a, 40);
    default: {
      const double w = size * dice.between(0.3, 0.45);
      return {{-a, -a}, {a, -a}, {a, -a + w}, {-a + w, -a + w}, {-a + w, a}, {-a, a}};
    }
  }
}

double radius_of(const host::LinearRing& ring) {
  double radius = 0;
  for (const host::Point& p : ring) radius = std::max(radius, std::hypot(p.x, p.y));
  return radius;
}

}  // namespace fencepost::test
