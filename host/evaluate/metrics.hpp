// The error of one model against one true footprint. Map frame, metres.
#pragma once

#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Areas below this count as zero, m^2: a square of 0.03 mm.
inline constexpr double kNoArea = 1e-9;

/// Ratios in [0, 1].
struct Score {
  double recklessness = 1;  ///< share of the true footprint that the model does not enclose
  double paranoia = 1;      ///< share of the model that is not that footprint; an empty model has none
  double iou = 0;           ///< area of both over area of either
  bool empty = false;       ///< the model has no area: its paranoia is in no mean
};

/// Score of a model without area.
inline constexpr Score kEmptyScore{1, 1, 0, true};

/// kEmptyScore for a model without area, or with a coordinate that is not finite. Overlapping parts count once.
Score score(const MultiPolygon& model, const Polygon& footprint);

/// Centroid of the area without its holes; of an outline without area its first vertex.
Point centroid(const Polygon& polygon);

/// From the centroid to the farthest vertex.
double circumscribed_radius(const Polygon& polygon);

}  // namespace fencepost::host
