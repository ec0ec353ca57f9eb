#include "tests/studies/hazards/encounter.hpp"

namespace fencepost::test {

Body Body::box(double front, double rear, double width) {
  const double half = width / 2;
  return {half, host::LinearRing{{-rear, -half}, {front, -half}, {front, half}, {-rear, half}}};
}

}  // namespace fencepost::test
