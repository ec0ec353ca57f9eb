// Numbers of the pose correction that were chosen and not derived. "Drift study" and "tours": chosen on simulated tours
// and on the recording D7_R2 from eight starts, judged on others. "By design": no study was made for the value.
#pragma once

#include <cstdint>

namespace fencepost::recon {

// --- landmarks ---

/// views of an object before it is a landmark: it is no noise then. By design.
inline constexpr std::uint32_t kViewsForLandmark = 3;
/// factor on the variances of a cylinder that becomes a landmark: it took the same frames and the same poses for
/// independent. Drift study.
inline constexpr float kOverconfidence = 4.0F;
/// m, largest radius of a landmark. By design.
inline constexpr float kLargestLandmark = 1.0F;
/// sigma of a first distance by a typical size, and by the row: shares of it; and beside the bearing, m. Drift study.
inline constexpr float kSizeShare = 0.5F;
inline constexpr float kRowShare = 0.25F;
inline constexpr float kAcross = 0.03F;
/// m. Farther away nothing is guessed. By design.
inline constexpr float kFarthestLandmark = 10.0F;
/// sine of the half angle under which a landmark is seen, at most: the lens is not inside the circle. By design.
inline constexpr float kWidestSine = 0.95F;

// --- the filter ---

/// variance (m^2, rad^2) of the start, which defines the map frame; zero would leave the first equations no margin.
inline constexpr float kStartVariance = 1e-6F;
/// sigmas. Farther off, a tangent is not this landmark's; beyond the second it counts less, as Huber has it.
/// algorithms.md sec. 7.
inline constexpr float kFilterGateSigmas = 3.0F;
inline constexpr float kHuberSigmas = 2.0F;
/// m and rad. One tangent does not move a robot farther: the numbers are wrong. By design.
inline constexpr float kFarthestStep = 2.0F;
inline constexpr float kWidestTurn = 0.8F;
/// share of each variance that is added in each update, to cover rounding: 1 % in ten thousand updates. Derived.
inline constexpr float kRounding = 1e-6F;
/// m, smallest radius of a landmark. By design.
inline constexpr float kSmallestLandmark = 0.005F;

// --- drift and models ---

/// Odometry whose distances are off by `share`: position m/sqrt(m), heading rad/sqrt(m), turning rad/sqrt(rad), each as
/// a factor on the share. With 3 % a robot turns 2 degrees a metre by itself. Drift study.
inline constexpr float kDriftPosition = 0.4F;
inline constexpr float kDriftHeading = 0.67F;
inline constexpr float kDriftTurning = 1.0F;
/// rad and m, sigmas of corrected poses for the models: what is left of the pose's error. algorithms.md sec. 7.
inline constexpr float kCorrectedHeading = 0.0105F;
inline constexpr float kCorrectedPosition = 0.006F;

}  // namespace fencepost::recon
