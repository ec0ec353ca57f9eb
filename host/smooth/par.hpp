// One map and path against another after the turn and shift that bring them nearest.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// A turn about the origin, then a shift: of the floor, m and rad.
struct FloorMotion {
  double turn = 0;
  Point shift;
  [[nodiscard]] Point operator()(Point p) const;
};

struct PointPair {
  Point from;
  Point to;
};

/// The least-squares motion that brings `from` to `to`; of one pair a shift only, of none nothing.
FloorMotion aligned(std::span<const PointPair> pairs);
/// Distances that are left after it.
std::vector<double> distances_after(const FloorMotion& motion, std::span<const PointPair> pairs);
double rms_of(const std::vector<double>& values);

/// How far the online map and path are from the optimum.
struct Par {
  FloorMotion motion;  ///< online onto optimum
  std::size_t objects_online = 0;
  std::size_t objects_optimum = 0;
  std::size_t pairs = 0;    ///< of objects that are in both
  double map_rms = 0;       ///< m
  double map_worst = 0;     ///< m
  double path_rms = 0;      ///< m, of the path by itself after its own alignment
  double end_off = 0;       ///< m, the last pose without alignment, from the same start
  double heading_mean = 0;  ///< rad, mean of the magnitudes without alignment
};

}  // namespace fencepost::host
