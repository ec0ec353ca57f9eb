// How far a problem's sightings are from what an estimate predicts.
#pragma once

#include <optional>
#include <vector>

#include "host/calibrate/problem.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::host {

/// Predicted minus seen, px. An edge that was not seen is missing.
struct SightingResidual {
  std::optional<double> left{};
  std::optional<double> right{};
  std::optional<double> foot{};
  std::optional<double> top{};
  double range = 0;  ///< m, to the object's middle
  double ahead = 0;  ///< m, the same along the lens's axis
  /// The floor under the box's foot, map; missing where it is above the horizon.
  std::optional<Point> floor{};
};

/// The residual of one sighting; its object and node are the estimate's.
SightingResidual residual_of(const CalibrationProblem& problem, const Estimate& estimate, const Sighting& sighting);

std::vector<SightingResidual> residuals_at(const CalibrationProblem& problem, const Estimate& estimate);

/// The image's noise by the median of the residuals: a few outliers do not matter.
ImageNoise noise_of(const std::vector<SightingResidual>& residuals);

/// One edge for the picture: where in the image, and by how much it is missed.
struct EdgeResidual {
  double column = 0;
  double residual = 0;  ///< px
};

struct Residuals {
  double columns_px = 0;  ///< 68 % of all edges are nearer
  double columns_cm = 0;  ///< the same at the object's distance
  double rows_px = 0;
  std::vector<EdgeResidual> edges;
};

Residuals summarise_residuals(const CalibrationProblem& problem, const std::vector<SightingResidual>& residuals,
                              double focal_length);

}  // namespace fencepost::host
