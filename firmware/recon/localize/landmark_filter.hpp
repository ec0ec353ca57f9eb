// Pose correction: an extended Kalman filter over the robot's pose and its landmarks, which are static circles. It
// knows no camera and no object: odometry and tangents in the robot frame come in, poses go out.
//
// A tangent n.q = b of a circle (c, r), robot frame, gives the equation n.R'(c - P) + r = b. It is linear in (c, r) and
// one number, so no matrix is inverted. Half the sum and half the difference of two such equations have the same form.
// The error of a place leaves out by how much the heading's error has turned it about an origin (the right-invariant
// error, EQUATIONS.md section 8). To turn the whole map then changes no equation, whatever the estimates. Otherwise it
// does once they change, and the filter learns a heading that nothing has measured.
// Covariances are kept as one triangle, which cannot be asymmetric. Those between the radii of two landmarks are not
// kept; each is added to both variances instead. That is the safe side: for any d the matrix [|d| -d; -d |d|] is not
// negative. It saves N (N - 1) / 2 floats and costs about 1 % of the correction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/localize/tuning.hpp"
#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "hal/base/fixed.hpp"

namespace fencepost::recon {

/// Noise of odometry as random walks: a step of any length adds the same variance for each metre.
struct DriftNoise {
  float position = 0;  ///< m/sqrt(m) driven
  float heading = 0;   ///< rad/sqrt(m) driven
  float turning = 0;   ///< rad/sqrt(rad) turned
};

/// The noise of a wheel base whose distances are off by `share`.
constexpr DriftNoise drift_noise(float share) { return {kDriftPosition * share, kDriftHeading * share, share}; }

/// A static circle. Map frame.
struct Landmark {
  MapPoint center;
  float radius = 0;  ///< m; 0: there is none

  [[nodiscard]] bool used() const { return radius > 0; }
};

/// The first estimate of a landmark. Its covariance does not contain the pose's.
struct LandmarkGuess {
  Vec2 away{0, 0};  ///< from the robot to its centre, map axes, m
  float radius = 0;
  Symmetric3 covariance;  ///< map axes
};

/// An equation that a sighting gives for a circle (c, r), robot frame: normal.c + radii * r = bound. A tangent has a
/// unit normal and `radii` 1.
struct CircleEquation {
  Vec2 normal{0, 0};
  float bound = 0;  ///< m
  float radii = 1;
  /// The normal that the estimate predicts, for the derivatives; without noise it equals `normal`. With the measured
  /// normals as derivatives, noise would look like parallax and draw everything to the lens.
  Vec2 slope{0, 0};
};

struct PoseSigma {
  float position = 0;  ///< m, sqrt of the mean of both coordinates' variances
  float heading = 0;   ///< rad
};

enum class TangentFate : std::uint8_t {
  kUsed,
  kKnown,    ///< known far better than it was measured: not worth its cost, which is nearly all saved
  kGated,    ///< more than kFilterGateSigmas off: of something else, or cut short
  kRefused,  ///< the numbers would not be a covariance any more, or the step is absurd: nothing was changed
};

/// Packed covariances of `n` landmarks: first, by rows, the lower triangle over the places. These are x, y, heading,
/// then x, y of each landmark. For each radius its covariances with all places and its variance follow.
constexpr std::size_t places_of(std::size_t n) { return 3 + 2 * n; }
constexpr std::size_t covariances_of(std::size_t n) {
  return places_of(n) * (places_of(n) + 1) / 2 + n * (places_of(n) + 1);
}
/// The number of states, one for each place and each radius: the size of `scratch`.
constexpr std::size_t states_of(std::size_t n) { return places_of(n) + n; }

struct FilterPose {
  MapPose pose;      ///< corrected
  MapPose odometry;  ///< the same moment by odometry
};

/// How much worse odometry is than configured, as the innovations show.
struct DriftGauge {
  float factor = 1;  ///< on the variances of the noise, from 1 to kMaxDrift
  /// Variances of what was driven and not compared with any equation yet, m^2 and rad^2.
  float position = 0;
  float heading = 0;
  float surprise = 0;  ///< of the latest equation: its squared residual over the expected one, at most kMaxSurprise
  float usual = 1;     ///< running mean of the surprises
};

/// Any filter, whatever its number of landmarks.
struct FilterView {
  FilterPose& at;
  MapPoint& origin;  ///< of the turns by the heading's error; it follows the robot
  DriftGauge& gauge;
  std::span<Landmark> landmarks;
  std::span<float> covariance;
  /// The slots up to the last landmark when this was made. Covariances of those behind it are zero and stay so: after
  /// add_landmark() another view is needed.
  std::size_t in_use = landmarks.size();
};

/// The pose now, given where odometry has come since `at`; exactly the odometry as long as nothing was corrected.
MapPose corrected(const FilterPose& at, const MapPose& odometry);

/// `v` turned left by an angle (urad).
Vec2 turned(const Vec2& v, std::int32_t angle);

/// No landmarks, and a pose that is known: it is what the map frame is.
void start(const FilterView& filter);
/// The robot has moved to `odometry`. `scratch` has states_of() elements, here and below.
void drive_to(const FilterView& filter, const MapPose& odometry, const DriftNoise& noise, std::span<float> scratch);
void add_landmark(const FilterView& filter, std::size_t slot, const LandmarkGuess& guess);
void forget_landmark(const FilterView& filter, std::size_t slot);

/// Updates the filter with one equation of the landmark in `slot`; `variance` (m^2) of its bound, non-roundness
/// included. The equation is left out if the prior variance of its bound is below the share `min_share` of that.
/// Residuals beyond two sigmas count less, by Huber's weight. Cost: (places^2 + 4 places * landmarks) multiplications,
/// of those in use.
TangentFate correct_by(const FilterView& filter, std::size_t slot, const CircleEquation& seen, float variance,
                       std::span<float> scratch, float min_share = 0);

/// The landmark relative to the robot: its centre from the pose's position, map axes. The covariance is that of the
/// difference and includes the heading's part.
CylinderEstimate seen_from_robot(const FilterView& filter, std::size_t slot);
/// The sigmas of the pose, from its packed covariances and its position from the filter's origin (m).
PoseSigma pose_sigma(std::span<const float> covariance, const Vec2& from_origin);
/// Squared distance of another pose from the filter's, in sigmas of the filter's (Mahalanobis, 3 degrees of freedom).
float distance_to(const FilterView& filter, const MapPose& other);

template <std::size_t kLandmarks>
class LandmarkFilter {
 public:
  static constexpr std::size_t kStates = states_of(kLandmarks);

  [[nodiscard, gnu::noinline]] FilterView view() {
    return {at_, origin_, gauge_, landmarks_, covariance_, base::slots_in_use(landmarks_)};
  }
  [[nodiscard]] const Landmark& landmark(std::size_t slot) const { return landmarks_[slot]; }
  [[nodiscard]] const FilterPose& at() const { return at_; }
  [[nodiscard]] const MapPoint& origin() const { return origin_; }
  [[nodiscard]] const DriftGauge& gauge() const { return gauge_; }
  [[nodiscard]] PoseSigma sigma() const {
    return pose_sigma(pose_covariances(), offset_from(origin_, at_.pose.position));
  }
  /// For the digest: of the pose alone; of one landmark's place with all before it; of its radius with all places.
  [[nodiscard]] std::span<const float> pose_covariances() const { return std::span(covariance_).first(6); }
  [[nodiscard]] std::span<const float> place_covariances(std::size_t slot) const {
    const std::size_t row = places_of(slot);
    return std::span(covariance_).subspan(row * (row + 1) / 2, 2 * row + 3);
  }
  [[nodiscard]] std::span<const float> radius_covariances(std::size_t slot) const {
    constexpr std::size_t kRow = places_of(kLandmarks) + 1;
    return std::span(covariance_).last(kLandmarks * kRow).subspan(slot * kRow, kRow);
  }

 private:
  FilterPose at_;
  MapPoint origin_;
  DriftGauge gauge_;
  std::array<Landmark, kLandmarks> landmarks_{};
  std::array<float, covariances_of(kLandmarks)> covariance_{};
};

}  // namespace fencepost::recon
