// Footprints of the published tables: box, triangle, round, L; 0.06 to 0.26 m across.
#pragma once

#include <random>

#include "host/geometry/polygon.hpp"
#include "host/scene/scene.hpp"

namespace fencepost::test {

/// The same draws everywhere: the standard engine, our own distributions.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double a, double b) { return a + (b - a) * (static_cast<double>(random_()) / 4294967296.0); }
  unsigned below(unsigned n) { return static_cast<unsigned>(random_()) % n; }

 private:
  std::mt19937 random_;
};

/// Around the origin, counter-clockwise, one of the four shapes.
host::LinearRing random_footprint(Dice& dice);

/// From the origin to the farthest vertex, m.
double radius_of(const host::LinearRing& ring);

}  // namespace fencepost::test
