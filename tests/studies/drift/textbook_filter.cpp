#include "tests/studies/drift/textbook_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "firmware/recon/observe/sighting.hpp"
#include "firmware/record/decode.hpp"
#include "host/import/text_lines.hpp"

namespace fencepost::test {
namespace {

// Of odometry that logs commanded velocities; chosen on D1.
constexpr double kAlong = 0.055;          // m, after a metre
constexpr double kAcross = 0.027;         // m, after a metre
constexpr double kTurn = 0.106;           // rad, after a turn of a radian
constexpr double kTurnByMetre = 0.06;     // rad
constexpr double kBearing = 0.015;        // rad
constexpr double kRangeShare = 0.06;      // of the range
constexpr double kRange = 0.02;           // m, beside it
constexpr double kNoRange = 1'000;        // m, sigma of a range that was not measured
constexpr double kGate = 11.8;            // 99.7 % of two degrees of freedom
constexpr int kDoubted = 6;               // misses in a row after which the pose is doubted
constexpr double kDoubtedPlace = 0.1;     // m
constexpr double kDoubtedHeading = 0.14;  // rad

double squared(double x) { return x * x; }
double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// A frame's exposure lies between the last two samples of odometry: it comes after them.
struct LogReader {
  double radius = 0;
  std::uint8_t unknown = 0;
  TextbookFilter filter;
  recon::CameraModel camera;
  std::vector<host::TimedPose> path;
  host::TimedPose at;  ///< of the filter, by odometry
  std::optional<host::TimedPose> last;

  void move_to(const host::TimedPose& pose) {
    const double c = std::cos(at.heading), s = std::sin(at.heading);
    const double dx = pose.x - at.x, dy = pose.y - at.y;
    filter.move(c * dx + s * dy, c * dy - s * dx, wrapped(pose.heading - at.heading));
    at = pose;
  }
  void accept(const sensor::CameraIntrinsics& intrinsics) { camera = recon::make_camera_model(intrinsics); }
  void accept(const sensor::OdometrySample& sample) {
    const host::TimedPose pose{sample.t.to_double(), sample.x.to_double(), sample.y.to_double(),
                               sample.heading.to_double()};
    if (last) {
      move_to(*last);
    } else {
      at = pose;
    }
    last = pose;
  }
  void accept(const sensor::BlobFrame& frame) {
    const double t = frame.t.to_double();
    if (last && t > at.t && last->t > at.t) {
      const double share = std::min(1.0, (t - at.t) / (last->t - at.t));
      move_to({t, at.x + share * (last->x - at.x), at.y + share * (last->y - at.y),
               at.heading + share * wrapped(last->heading - at.heading)});
    }
    path.push_back(filter.pose());
    path.back().t = t;
    for (const sensor::Blob& blob : frame.blobs) {
      if (blob.signature != unknown) see(blob);
    }
  }
  void see(const sensor::Blob& blob) {
    const recon::Observation seen = recon::observe_alone(camera, {blob.x1, blob.y1, blob.x2, blob.y2});
    const recon::Sighting sighting = recon::make_sighting(camera, recon::lens_pose({}, camera), seen);
    if (!sighting.both_edges()) return;  // half a box has no middle
    const double bearing =
        std::atan2(static_cast<double>(sighting.center.y()), static_cast<double>(sighting.center.x()));
    std::optional<double> range;
    if (sighting.rows_known && recon::is_edge(sighting.bottom.end) && sighting.bottom.drop > 0)
      range = static_cast<double>(sighting.lens_height / sighting.bottom.drop) / std::cos(bearing) + radius;
    filter.see(blob.signature, bearing, range);
  }
  template <class Other>
  void accept(const Other&) {}
};

}  // namespace

void TextbookFilter::move(double forward, double left, double turn) {
  const double c = std::cos(state_(2)), s = std::sin(state_(2));
  const double dx = c * forward - s * left, dy = s * forward + c * left;
  Eigen::Matrix3d step = Eigen::Matrix3d::Identity();
  step(0, 2) = -dy;
  step(1, 2) = dx;
  state_(0) += dx;
  state_(1) += dy;
  state_(2) += turn;
  covariance_.topRows<3>() = (step * covariance_.topRows<3>()).eval();
  covariance_.leftCols<3>() = (covariance_.leftCols<3>() * step.transpose()).eval();
  const double way = std::hypot(forward, left);
  Eigen::Matrix2d axes;
  axes << c, -s, s, c;
  const Eigen::Vector2d spread(squared(kAlong) * way, squared(kAcross) * way);
  covariance_.topLeftCorner<2, 2>() += axes * spread.asDiagonal() * axes.transpose();
  covariance_(2, 2) += squared(kTurn) * std::fabs(turn) + squared(kTurnByMetre) * way;
}

void TextbookFilter::begin(std::uint8_t signature, double bearing, double range) {
  const auto at = state_.size();
  if (at + 2 > kMaxStates) return;
  const double angle = state_(2) + bearing;
  const double c = std::cos(angle), s = std::sin(angle);
  Eigen::Matrix<double, 2, 3> by_pose;
  by_pose << 1, 0, -range * s, 0, 1, range * c;
  Eigen::Matrix2d by_seen;
  by_seen << -range * s, c, range * c, s;
  const Eigen::Vector2d variances(squared(2 * kBearing), squared(2 * kRangeShare * range + 0.1));
  State state(at + 2);
  state << state_, state_(0) + range * c, state_(1) + range * s;
  Covariance covariance = Covariance::Zero(at + 2, at + 2);
  covariance.topLeftCorner(at, at) = covariance_;
  covariance.bottomLeftCorner(2, at) = by_pose * covariance_.topRows<3>();
  covariance.topRightCorner(at, 2) = covariance.bottomLeftCorner(2, at).transpose();
  covariance.bottomRightCorner<2, 2>() = by_pose * covariance_.topLeftCorner<3, 3>() * by_pose.transpose() +
                                         by_seen * variances.asDiagonal() * by_seen.transpose();
  state_ = state;
  covariance_ = covariance;
  places_[signature] = static_cast<int>(at);
}

void TextbookFilter::see(std::uint8_t signature, double bearing, std::optional<double> range) {
  const auto known = places_.find(signature);
  if (known == places_.end()) {
    if (range) begin(signature, bearing, *range);
    return;
  }
  const int at = known->second;
  const double dx = state_(at) - state_(0), dy = state_(at + 1) - state_(1);
  const double away = std::hypot(dx, dy);
  Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMaxStates> model = decltype(model)::Zero(2, state_.size());
  const Eigen::Vector2d turned(-dy / squared(away), dx / squared(away));
  const Eigen::Vector2d farther(dx / away, dy / away);
  model.block<1, 2>(0, at) = turned.transpose();
  model.block<1, 2>(0, 0) = -turned.transpose();
  model(0, 2) = -1;
  model.block<1, 2>(1, at) = farther.transpose();
  model.block<1, 2>(1, 0) = -farther.transpose();
  const Eigen::Vector2d off(wrapped(bearing - std::atan2(dy, dx) + state_(2)), range.value_or(away) - away);
  const Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMaxStates, 2> shared = covariance_ * model.transpose();
  Eigen::Matrix2d expected = model * shared;
  expected(0, 0) += squared(kBearing);
  expected(1, 1) += squared(range ? kRangeShare * away + kRange : kNoRange);
  const Eigen::Matrix2d inverse = expected.inverse();
  int& missed = missed_[signature];
  if (off.dot(inverse * off) > kGate) {
    if (++missed < kDoubted) return;
    missed = 0;
    covariance_(0, 0) += squared(kDoubtedPlace);
    covariance_(1, 1) += squared(kDoubtedPlace);
    covariance_(2, 2) += squared(kDoubtedHeading);
    return;
  }
  missed = 0;
  const Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMaxStates, 2> gain = shared * inverse;
  state_ += gain * off;
  covariance_ -= gain * shared.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
}

std::map<std::uint8_t, host::Point> TextbookFilter::landmarks() const {
  std::map<std::uint8_t, host::Point> found;
  for (const auto& [signature, at] : places_) found[signature] = {state_(at), state_(at + 1)};
  return found;
}

TextbookRun run_textbook(const std::string& log, double radius, std::uint8_t unknown) {
  LogReader reader;
  reader.radius = radius;
  reader.unknown = unknown;
  for (const std::string_view line : host::lines_of(log)) {
    if (!record::decode(line, {}, reader)) throw std::runtime_error("not a record: " + std::string(line));
  }
  return {reader.filter.landmarks(), std::move(reader.path)};
}

}  // namespace fencepost::test
