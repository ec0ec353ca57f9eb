#include "host/calibrate/solver.hpp"

#include <ceres/ceres.h>
#include <glog/logging.h>

#include <utility>
#include <vector>

#include "host/calibrate/drift_model.hpp"
#include "host/calibrate/sighting_model.hpp"

namespace fencepost::host {
namespace {

using calibration::Pose;
using calibration::View;

constexpr int kCamera = kCameraParameters;
constexpr int kWheels = kWheelParameters;
constexpr int kObject = kObjectParameters;
constexpr int kPose = kPoseParameters;
constexpr int kKind = kKindParameters;

/// Residuals of this many sigmas count half as much as a square would: with gaussian noise hardly any is.
constexpr double kRobustWidth = 2.5;

/// Common to all residuals of a sighting.
struct Seen {
  const CalibrationProblem* problem;
  const Sighting* sighting;

  template <class T>
  [[nodiscard]] View<T> view(const T* camera, const T* wheels, const T* node) const {
    const double node_time = problem->node_times[sighting->node];
    const Pose<T> robot =
        calibration::pose_at_exposure<T>(problem->odometry, node_time, sighting->t, camera[kLatency], wheels, node);
    return calibration::view_of(problem->optics, camera, robot);
  }
  /// Predicted minus seen.
  template <class T>
  T edge(const T* camera, const View<T>& seen, const T* object, const T* kind, double column, double sign) const {
    const double bare = column + sign * calibration::value_of(kind[kPad]);
    return calibration::edge_column<T>(problem->optics, camera, seen, object, *sighting, bare, sign) -
           sign * kind[kPad] - column;
  }
};

/// Both edges: their middle and their distance have errors of their own. An error of the robot's pose shifts both.
struct BothEdges : Seen {
  template <class T>
  bool operator()(const T* camera, const T* wheels, const T* node, const T* object, const T* kind, T* residuals) const {
    const View<T> seen = view(camera, wheels, node);
    const T left = edge(camera, seen, object, kind, *sighting->left, 1);
    const T right = edge(camera, seen, object, kind, *sighting->right, -1);
    residuals[0] = 0.5 * (left + right) / problem->noise.middle;
    residuals[1] = (right - left) / problem->noise.width;
    return true;
  }
};

struct OneEdge : Seen {
  template <class T>
  bool operator()(const T* camera, const T* wheels, const T* node, const T* object, const T* kind, T* residual) const {
    const View<T> seen = view(camera, wheels, node);
    const double sign = sighting->left ? 1 : -1;
    const double column = sighting->left ? *sighting->left : *sighting->right;
    residual[0] = edge(camera, seen, object, kind, column, sign) / problem->noise.edge;
    return true;
  }
};

struct Foot : Seen {
  template <class T>
  bool operator()(const T* camera, const T* wheels, const T* node, const T* object, const T* kind, T* residual) const {
    const T row =
        calibration::foot_row<T>(problem->optics, camera, view(camera, wheels, node), object, sighting->middle);
    residual[0] = (row + kind[kPad] - *sighting->foot) / problem->noise.foot;
    return true;
  }
};

struct Top : Seen {
  template <class T>
  bool operator()(const T* camera, const T* wheels, const T* node, const T* object, const T* kind, T* residual) const {
    const T row =
        calibration::top_row<T>(problem->optics, camera, view(camera, wheels, node), object, sighting->middle);
    residual[0] = (row - kind[kPad] - *sighting->top) / problem->noise.top;
    return true;
  }
};

/// The odometry between two nodes.
struct Driven {
  calibration::Motion<double> motion;
  PoseNoise sigma;
  template <class T>
  bool operator()(const T* wheels, const T* from, const T* to, T* residuals) const {
    const calibration::Motion<T> reported{T(motion.ahead), T(motion.left), T(motion.turn), T(motion.way)};
    const Pose<T> expected = calibration::after(from, calibration::corrected(reported, wheels));
    residuals[0] = (to[kPoseX] - expected.x) / sigma.position;
    residuals[1] = (to[kPoseY] - expected.y) / sigma.position;
    residuals[2] = (to[kPoseHeading] - expected.heading) / sigma.heading;
    return true;
  }
};

/// A Gaussian prior for each parameter.
template <std::size_t Count>
struct Prior {
  std::array<double, Count> middle;
  std::array<double, Count> sigma;
  template <class T>
  bool operator()(const T* values, T* residuals) const {
    for (std::size_t i = 0; i < Count; ++i) residuals[i] = (values[i] - middle[i]) / sigma[i];
    return true;
  }
};

struct Size {
  KnownSize known;
  template <class T>
  bool operator()(const T* object, const T* kind, T* residual) const {
    residual[0] = (2.0 * object[kRadius] - known.width * exp(kind[kWidthRatio])) / known.sigma;
    return true;
  }
};

struct Apart {
  double distance;
  template <class T>
  bool operator()(const T* a, const T* b, T* residual) const {
    constexpr double kSigma = 0.003;  // m, middle to middle
    const T dx = a[kCentreX] - b[kCentreX];
    const T dy = a[kCentreY] - b[kCentreY];
    residual[0] = (sqrt(dx * dx + dy * dy + 1e-12) - distance) / kSigma;
    return true;
  }
};

/// Networks were seen to pad by 7 px a side; a width that somebody measured is seldom off by half.
constexpr KindValues kKindSigma = {10, 0.4};

/// An object is convex and not far from round: a square's harmonics are 2 r / (m^2 - 1), every other one. The prior of
/// place and top is weak, but keeps an object seen once from running away.
Prior<kObjectParameters> object_prior(const ObjectValues& start, double radius) {
  constexpr double kUnround = 0.8;
  Prior<kObjectParameters> prior;
  prior.middle = start;
  prior.sigma.fill(2);
  prior.sigma[kTop] = 0.5;
  prior.middle[kRadius] = radius;
  prior.sigma[kRadius] = 0.1;
  for (std::size_t m = 2; m <= kLastHarmonic; ++m) {
    const double order = static_cast<double>(m);
    for (std::size_t i = 0; i < 2; ++i) {
      prior.middle[kShape + 2 * (m - 2) + i] = 0;
      prior.sigma[kShape + 2 * (m - 2) + i] = kUnround * radius / (order * order - 1);
    }
  }
  return prior;
}

/// The parameters of an estimate as Ceres sees them.
class Build {
 public:
  Build(const CalibrationProblem& problem, const SolverOptions& options, Estimate& estimate)
      : problem_(problem), options_(options), estimate_(estimate), ceres_(ownership()) {
    ceres_.AddParameterBlock(estimate_.camera.data(), kCamera);
    ceres_.AddParameterBlock(estimate_.wheels.data(), kWheels);
    for (PoseValues& node : estimate_.nodes) ceres_.AddParameterBlock(node.data(), kPose);
    for (KindValues& kind : estimate_.kinds) ceres_.AddParameterBlock(kind.data(), kKind);
    add_sightings();
    add_odometry();
    add_priors();
    hold(estimate_.camera.data(), options_.hold_camera);
    hold(estimate_.wheels.data(), options_.hold_wheels);
    for (std::size_t i = 0; i < estimate_.kinds.size(); ++i) hold_kind(i);
    ceres_.SetParameterBlockConstant(estimate_.nodes.front().data());
    if (options_.hold_way) {
      for (PoseValues& node : estimate_.nodes) ceres_.SetParameterBlockConstant(node.data());
    }
  }

  ceres::Problem& problem() { return ceres_; }

 private:
  static ceres::Problem::Options ownership() {
    ceres::Problem::Options options;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  template <class Function, int Residuals>
  void add(const Sighting& sighting) {
    auto* cost = new ceres::AutoDiffCostFunction<Function, Residuals, kCamera, kWheels, kPose, kObject, kKind>(
        new Function{{&problem_, &sighting}});
    ceres_.AddResidualBlock(cost, &robust_, estimate_.camera.data(), estimate_.wheels.data(),
                            estimate_.nodes[sighting.node].data(), estimate_.objects[sighting.object].data(),
                            kind_of(sighting.object));
  }
  double* kind_of(std::size_t object) { return estimate_.kinds[problem_.kinds[object]].data(); }
  void hold_kind(std::size_t i) {
    std::array<bool, kKindParameters> held{};
    for (std::size_t k = 0; k < held.size(); ++k) {
      held[k] = i >= options_.free_kinds.size() || !options_.free_kinds[i][k];
    }
    hold(estimate_.kinds[i].data(), held);
  }

  void add_sightings() {
    for (const Sighting& sighting : problem_.sightings) {
      if (sighting.left && sighting.right) {
        add<BothEdges, 2>(sighting);
      } else if (sighting.left || sighting.right) {
        add<OneEdge, 1>(sighting);
      }
      if (sighting.foot && problem_.rows) add<Foot, 1>(sighting);
      if (sighting.top && problem_.rows) add<Top, 1>(sighting);
    }
  }

  void add_odometry() {
    for (std::size_t i = 0; i + 1 < problem_.node_times.size(); ++i) {
      const TrackPose a = problem_.odometry.at(problem_.node_times[i]);
      const TrackPose b = problem_.odometry.at(problem_.node_times[i + 1]);
      auto* cost = new ceres::AutoDiffCostFunction<Driven, kPose, kWheels, kPose, kPose>(
          new Driven{calibration::motion_between(a, b), calibration::stray(a, b, problem_.drift, problem_.walk)});
      ceres_.AddResidualBlock(cost, nullptr, estimate_.wheels.data(), estimate_.nodes[i].data(),
                              estimate_.nodes[i + 1].data());
    }
  }

  void add_priors() {
    ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<kCameraParameters>, kCamera, kCamera>(
                                new Prior<kCameraParameters>{problem_.configured, problem_.camera_sigma}),
                            nullptr, estimate_.camera.data());
    ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<kWheelParameters>, kWheels, kWheels>(
                                new Prior<kWheelParameters>{WheelValues{}, problem_.wheel_sigma}),
                            nullptr, estimate_.wheels.data());
    for (std::size_t o = 0; o < estimate_.objects.size(); ++o) {
      ObjectValues& object = estimate_.objects[o];
      ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<kObjectParameters>, kObject, kObject>(
                                  new Prior<kObjectParameters>(object_prior(object, problem_.radii[o]))),
                              nullptr, object.data());
      if (!options_.hold_shape) continue;
      std::array<bool, kObjectParameters> shape{};
      std::fill(shape.begin() + kShape, shape.end(), true);
      hold(object.data(), shape);
    }
    for (const KnownSize& size : problem_.sizes) {
      ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Size, 1, kObject, kKind>(new Size{size}), nullptr,
                              estimate_.objects[size.object].data(), kind_of(size.object));
    }
    for (KindValues& kind : estimate_.kinds) {
      ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Prior<kKindParameters>, kKind, kKind>(
                                  new Prior<kKindParameters>{{}, kKindSigma}),
                              nullptr, kind.data());
    }
    for (const KnownDistance& apart : problem_.distances) {
      ceres_.AddResidualBlock(new ceres::AutoDiffCostFunction<Apart, 1, kObject, kObject>(new Apart{apart.distance}),
                              nullptr, estimate_.objects[apart.a].data(), estimate_.objects[apart.b].data());
    }
  }

  template <std::size_t Count>
  void hold(double* block, const std::array<bool, Count>& held) {
    std::vector<int> constant;
    for (std::size_t i = 0; i < Count; ++i) {
      if (held[i]) constant.push_back(static_cast<int>(i));
    }
    if (constant.size() == Count) {
      ceres_.SetParameterBlockConstant(block);
    } else if (!constant.empty()) {
      ceres_.SetManifold(block, new ceres::SubsetManifold(static_cast<int>(Count), constant));
    }
  }

  const CalibrationProblem& problem_;
  const SolverOptions& options_;
  Estimate& estimate_;
  ceres::CauchyLoss robust_{kRobustWidth};
  ceres::Problem ceres_;
};

/// Ceres logs on standard error what is answered here.
void keep_quiet() { FLAGS_minloglevel = google::GLOG_FATAL; }

ceres::Covariance::Options by_sparse_qr() {
  ceres::Covariance::Options how;
  how.algorithm_type = ceres::SPARSE_QR;
  how.num_threads = 1;
  return how;
}

}  // namespace

std::optional<std::string> solve(const CalibrationProblem& problem, const SolverOptions& options, Estimate& estimate) {
  keep_quiet();
  Build build(problem, options, estimate);
  ceres::Solver::Options how;
  how.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  how.logging_type = ceres::SILENT;
  how.max_num_iterations = options.iterations;
  how.function_tolerance = 1e-7;
  how.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(how, &build.problem(), &summary);
  if (!summary.IsSolutionUsable()) return summary.message;
  return std::nullopt;
}

double cost_at(const CalibrationProblem& problem, const SolverOptions& options, Estimate estimate) {
  keep_quiet();
  Build build(problem, options, estimate);
  double cost = 0;
  build.problem().Evaluate({}, &cost, nullptr, nullptr, nullptr);
  return cost;
}

std::vector<PlaceVariance> place_variances(const CalibrationProblem& problem, const SolverOptions& options,
                                           Estimate estimate) {
  keep_quiet();
  Build build(problem, options, estimate);
  ceres::Covariance covariance(by_sparse_qr());
  std::vector<std::pair<const double*, const double*>> blocks;
  for (const ObjectValues& object : estimate.objects) blocks.emplace_back(object.data(), object.data());
  if (blocks.empty() || !covariance.Compute(blocks, &build.problem())) return {};
  std::vector<PlaceVariance> variances;
  std::array<double, kObjectParameters * kObjectParameters> values{};
  for (const ObjectValues& object : estimate.objects) {
    if (!covariance.GetCovarianceBlock(object.data(), object.data(), values.data())) return {};
    variances.push_back({values[kCentreX * kObjectParameters + kCentreX],
                         values[kCentreX * kObjectParameters + kCentreY],
                         values[kCentreY * kObjectParameters + kCentreY]});
  }
  return variances;
}

std::optional<CalibratedMatrix> covariance_at(const CalibrationProblem& problem, const SolverOptions& options,
                                              Estimate estimate) {
  keep_quiet();
  Build build(problem, options, estimate);
  ceres::Covariance covariance(by_sparse_qr());
  std::vector<const double*> blocks = {estimate.camera.data(), estimate.wheels.data()};
  if (!options.free_kinds.empty()) {
    for (const KindValues& kind : estimate.kinds) blocks.push_back(kind.data());
  }
  std::vector<std::pair<const double*, const double*>> pairs;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t j = i; j < blocks.size(); ++j) pairs.emplace_back(blocks[i], blocks[j]);
  }
  if (!covariance.Compute(pairs, &build.problem())) return std::nullopt;
  const std::size_t size = place_of(blocks.size() - 2, kPad);
  std::vector<double> values(size * size);
  if (!covariance.GetCovarianceMatrix(blocks, values.data())) return std::nullopt;
  CalibratedMatrix matrix;
  for (auto row = values.begin(); row != values.end(); row += static_cast<std::ptrdiff_t>(size)) {
    matrix.emplace_back(row, row + static_cast<std::ptrdiff_t>(size));
  }
  return matrix;
}

}  // namespace fencepost::host
