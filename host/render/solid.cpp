#include "host/render/solid.hpp"

#include <algorithm>

#include "host/geometry/rings.hpp"

namespace fencepost::host {

Solid solid_of(const Scene& scene, std::size_t object) {
  const SceneObject& truth = scene.objects[object];
  Solid solid{{truth.footprint}, truth.base, truth.base + truth.height_m, truth.signature, {}, object};
  for (const SceneSignature& signature : scene.signatures) {
    if (signature.id == truth.signature) solid.colour = signature.rgb;
  }
  return solid;
}

bool encloses(const Solid& solid, double x, double y, double z) {
  if (z < solid.z_min || z > solid.z_max) return false;
  return std::any_of(solid.footprint.begin(), solid.footprint.end(), [&](const Polygon& polygon) {
    return contains(polygon, {x, y});
  });
}

}  // namespace fencepost::host
