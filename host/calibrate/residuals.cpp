#include "host/calibrate/residuals.hpp"

#include <algorithm>
#include <cmath>

#include "host/calibrate/sighting_model.hpp"

namespace fencepost::host {
namespace {

constexpr double kSigmaOfMedian = 1.4826;
constexpr double kMinNoise = 0.3;  // px: whole pixels alone have 0.29

double sigma_of(std::vector<double> magnitudes, double otherwise) {
  constexpr std::size_t kEnough = 10;
  if (magnitudes.size() < kEnough) return otherwise;
  return std::max(kMinNoise, kSigmaOfMedian * median_of(std::move(magnitudes)));
}

double share_below(std::vector<double> magnitudes, double share) {
  if (magnitudes.empty()) return 0;
  const auto at = magnitudes.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(magnitudes.size() - 1));
  std::nth_element(magnitudes.begin(), at, magnitudes.end());
  return *at;
}

std::optional<Point> floor_point(const CalibrationProblem& problem, const Sighting& sighting,
                                 const calibration::View<double>& view, const CameraValues& camera, double pad) {
  if (!problem.rows || !sighting.foot) return std::nullopt;
  const calibration::GroundRay ray =
      calibration::ground_ray(problem.optics, camera, sighting.middle, *sighting.foot - pad);
  constexpr double kHorizon = 0.02;  // rad
  if (ray.down < kHorizon * ray.ahead || ray.ahead <= 0) return std::nullopt;
  const double depth = camera[kHeight] * ray.ahead / ray.down;
  const double left = camera[kHeight] * ray.left / ray.down;
  return Point{view.x + depth * view.ahead_x - left * view.ahead_y,
               view.y + depth * view.ahead_y + left * view.ahead_x};
}

}  // namespace

SightingResidual residual_of(const CalibrationProblem& problem, const Estimate& estimate, const Sighting& sighting) {
  const double* camera = estimate.camera.data();
  const auto robot = calibration::pose_at_exposure<double>(
      problem.odometry, problem.node_times[sighting.node], sighting.t, estimate.camera[kLatency],
      estimate.wheels.data(), estimate.nodes[sighting.node].data());
  const auto view = calibration::view_of(problem.optics, camera, robot);
  const double* object = estimate.objects[sighting.object].data();
  const double pad = estimate.kinds[problem.kinds[sighting.object]][kPad];
  const auto edge = [&](double seen, double sign) {
    const double bare = seen + sign * pad;
    return calibration::edge_column(problem.optics, camera, view, object, sighting, bare, sign) - bare;
  };
  SightingResidual residual;
  const double dx = object[kCentreX] - view.x;
  const double dy = object[kCentreY] - view.y;
  residual.range = std::hypot(dx, dy);
  residual.ahead = dx * view.ahead_x + dy * view.ahead_y;
  if (sighting.left) residual.left = edge(*sighting.left, 1);
  if (sighting.right) residual.right = edge(*sighting.right, -1);
  residual.floor = floor_point(problem, sighting, view, estimate.camera, pad);
  if (!problem.rows) return residual;
  if (sighting.foot) {
    residual.foot = calibration::foot_row(problem.optics, camera, view, object, sighting.middle) + pad - *sighting.foot;
  }
  if (sighting.top) {
    residual.top = calibration::top_row(problem.optics, camera, view, object, sighting.middle) - pad - *sighting.top;
  }
  return residual;
}

std::vector<SightingResidual> residuals_at(const CalibrationProblem& problem, const Estimate& estimate) {
  std::vector<SightingResidual> all;
  all.reserve(problem.sightings.size());
  for (const Sighting& sighting : problem.sightings) all.push_back(residual_of(problem, estimate, sighting));
  return all;
}

ImageNoise noise_of(const std::vector<SightingResidual>& residuals) {
  std::vector<double> middles;
  std::vector<double> widths;
  std::vector<double> edges;
  std::vector<double> feet;
  std::vector<double> tops;
  for (const SightingResidual& residual : residuals) {
    if (residual.left && residual.right) {
      middles.push_back(std::abs(*residual.left + *residual.right) / 2);
      widths.push_back(std::abs(*residual.left - *residual.right));
    } else if (residual.left || residual.right) {
      edges.push_back(std::abs(residual.left ? *residual.left : *residual.right));
    }
    if (residual.foot) feet.push_back(std::abs(*residual.foot));
    if (residual.top) tops.push_back(std::abs(*residual.top));
  }
  ImageNoise noise;
  noise.middle = sigma_of(std::move(middles), 1);
  noise.width = sigma_of(std::move(widths), 2 * noise.middle);
  noise.edge = sigma_of(std::move(edges), std::hypot(noise.middle, noise.width / 2));
  noise.foot = sigma_of(std::move(feet), noise.edge);
  noise.top = sigma_of(std::move(tops), noise.edge);
  return noise;
}

Residuals summarise_residuals(const CalibrationProblem& problem, const std::vector<SightingResidual>& residuals,
                              double focal_length) {
  constexpr double kOneSigma = 0.683;
  Residuals summary;
  std::vector<double> columns;
  std::vector<double> metres;
  std::vector<double> rows;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const SightingResidual& residual = residuals[i];
    const Sighting& sighting = problem.sightings[i];
    const auto add = [&](const std::optional<double>& missed, const std::optional<double>& at) {
      if (!missed) return;
      summary.edges.push_back({*at, *missed});
      columns.push_back(std::abs(*missed));
      metres.push_back(std::abs(*missed) * residual.range / focal_length);
    };
    add(residual.left, sighting.left);
    add(residual.right, sighting.right);
    if (residual.foot) rows.push_back(std::abs(*residual.foot));
    if (residual.top) rows.push_back(std::abs(*residual.top));
  }
  summary.columns_px = share_below(std::move(columns), kOneSigma);
  summary.columns_cm = 100 * share_below(std::move(metres), kOneSigma);
  summary.rows_px = share_below(std::move(rows), kOneSigma);
  return summary;
}

}  // namespace fencepost::host
