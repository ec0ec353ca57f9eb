#include "host/models/cylinder_paper.hpp"

namespace fencepost::recon {
namespace {
// Determinant per squared view below which all bearings are parallel to float precision.
constexpr float kParallel = 1e-7F;
}  // namespace

void CylinderPaper::add(const Sighting& sighting, MapPoint origin) {
  if (!sighting.both_edges()) return;
  const Vec2 lens = sighting.lens_from(origin);
  const Vec2& bearing = sighting.center;
  const Vec2 normal = left_of(bearing);
  const float bound = normal.dot(lens);
  // sin^2 of the half angle = (1 - cos of the angle between the edges) / 2
  const Vec2 chord = sighting.left.direction - sighting.right.direction;
  const float sine = 0.5F * chord.norm();
  sums_.nxx += normal.x() * normal.x();
  sums_.nxy += normal.x() * normal.y();
  sums_.nyy += normal.y() * normal.y();
  sums_.moment += bound * normal;
  sums_.reach += sine * bearing;
  sums_.start += sine * bearing.dot(lens);
  sums_.views += 1.0F;
}

void CylinderPaper::move_origin(const Vec2& shift) {
  const Vec2 change{sums_.nxx * shift.x() + sums_.nxy * shift.y(), sums_.nxy * shift.x() + sums_.nyy * shift.y()};
  sums_.moment -= change;
  sums_.start -= sums_.reach.dot(shift);
}

PaperCylinder CylinderPaper::solve() const {
  const float determinant = sums_.nxx * sums_.nyy - sums_.nxy * sums_.nxy;
  if (sums_.views < 2 || !(determinant > kParallel * sums_.views * sums_.views)) return {};
  PaperCylinder cylinder;
  cylinder.center = {(sums_.nyy * sums_.moment.x() - sums_.nxy * sums_.moment.y()) / determinant,
                     (sums_.nxx * sums_.moment.y() - sums_.nxy * sums_.moment.x()) / determinant};
  cylinder.radius = (cylinder.center.dot(sums_.reach) - sums_.start) / sums_.views;
  cylinder.ok = cylinder.radius > 0;
  return cylinder;
}

}  // namespace fencepost::recon
