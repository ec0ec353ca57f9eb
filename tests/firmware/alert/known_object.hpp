// An object whose place is known exactly: seen from all around.
#pragma once

#include "firmware/recon/track/object.hpp"
#include "tests/firmware/recon/exact_view.hpp"

namespace fencepost::test {

/// Confirmed, round, map frame, metres.
inline recon::ObjectCore known_object(double x, double y, double radius) {
  recon::ObjectCore object;
  object.id = 1;
  object.signature = 1;
  object.confirmed = true;
  for (const host::Point& lens : arc({x, y}, 1.5, 40)) {
    const recon::Sighting sighting = view_of_circle({x, y}, radius, lens).sighting;
    object.cylinder.add(sighting, object.origin, 1, {});
    object.cylinder.solve(sighting.lens_from(object.origin), sighting.center, {});
  }
  return object;
}

}  // namespace fencepost::test
