// Numbers of the pose correction that were chosen and not derived. "Drift study" and "tours": chosen on simulated tours
// and on the recording D7_R2 from eight starts, judged on others. "By design": no study was made for the value.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"

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

// --- the check of the lens ---

/// urad of heading between the frames that are compared. More: objects leave the image before; less: the noise of
/// headings and edges counts more. By design.
inline constexpr std::int32_t kLensTurn = 150'000;
/// urad for each 0.1 ms, 0.15 rad/s: slower, odometry's rounding is a share of what it tells. By design.
inline constexpr std::int32_t kLensLeastRate = 15;
/// Between two frames; after a longer gap nothing is compared. By design.
inline constexpr base::Duration kLensLongestStep = base::milliseconds(500);
/// A latency told wrongly by so much (s) must not change a turn by more than this share, which it does while the robot
/// turns faster or slower than before. By design.
inline constexpr float kLensLatency = 0.05F;
inline constexpr float kLensUnsteady = 0.1F;
/// share of the turn that the lens's own way may make, for the object's distance may be wrong, and m, nearer than which
/// the lens's place on the robot matters too much. By design.
inline constexpr float kLensMostParallax = 0.25F;
inline constexpr float kLensNearest = 0.3F;
/// A sample off by more than this factor is something else's. By design.
inline constexpr float kLensMostOff = 2.5F;
/// rad, sigma of a sample, at least: edges, headings, and an object whose middle is not where its box has it. By
/// design.
inline constexpr float kLensSampleSigma = 0.015F;
/// Samples, and objects followed (or one twice), before anything is said; and samples at which half is forgotten. By
/// design.
inline constexpr std::uint8_t kLensLeastSamples = 4;
inline constexpr std::uint8_t kLensObjects = 2;
inline constexpr std::uint8_t kLensMostSamples = 64;
/// The focal length is wrong from this factor and so many sigmas on, and right again below these. Less: complaints
/// about lenses that do no harm, and about wheels. Hazard table (bases).
struct LensGate {
  float factor;
  float sigmas;
};
inline constexpr LensGate kLensWrong{1.15F, 5.0F};
inline constexpr LensGate kLensRight{1.10F, 3.0F};

}  // namespace fencepost::recon
