// Numbers of the models that were chosen and not derived. The hybrid's own are in hybrid/tuning.hpp. Those of the sheaf
// and of carving, which are the paper's, are in sheaf.hpp and carve.hpp. "Prototype": measured with one that is not in
// the repository. Equations: firmware/recon/EQUATIONS.md.
// "Tuning table": half and twice the value are not clearly better (tests/results/tuning.md). "Flat": nor worse.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/tuning.hpp"

namespace fencepost::recon {

// --- what is known before anything is seen ---

/// m, radius of a typical obstacle, for the first guess of a distance. It is also the prior that lets one edge and the
/// foot make a circle; both edges from two places outweigh it. Tuning table.
inline constexpr float kTypicalRadius = 0.08F;
/// m, its sigma. Tuning table.
inline constexpr float kRadiusSigma = 0.05F;
/// m, sigma of the radius if the distance is otherwise open or the radius negative. A rough place is better than none
/// for the next match and for the alert. Tuning table.
inline constexpr float kRadiusGuess = 0.01F;

/// Consecutive views with both ends before an object counts as seen whole. A wall longer than the image loses an end to
/// noise in one view or two. More: alerts say "something" instead of the object's name; less: stops between walls.
/// Hazard table (corridors, walls, approaches), seeds 1 to 40.
inline constexpr std::uint8_t kViewsWhole = 5;

/// Sigma of a configured radius, as a share of it: things of one colour are alike, and the user can measure. More: the
/// first range is worse; less: a wrongly configured size bends the outline. Car study, seeds 7001 to 7020.
inline constexpr float kKnownRadiusSigma = 0.05F;

/// The prior of a radius, m.
struct RadiusPrior {
  float mean = kTypicalRadius;
  float sigma = kRadiusSigma;
};
/// `known`: the radius configured for that colour, m; 0: none.
constexpr RadiusPrior radius_prior(float known) {
  if (known > 0) return {known, kKnownRadiusSigma * known};
  return {};
}

/// m, radius of an object known by bearings alone, and its sigma: a point, for its width is unknown. No landmark is
/// smaller. Tuning table, flat.
inline constexpr float kPointRadius = 0.005F;

// --- novelty ---

/// share of the distance by which the lens has to move for a view to count in full. More: slow learning, worse with
/// real boxes. Tuning table.
inline constexpr float kNovelShare = 0.03F;
/// share of a view that counts at least. More: a parked robot becomes certain. Tuning table, flat.
inline constexpr float kMinNovelty = 0.05F;
/// m. Nearer distances count as this one. Tuning table, flat.
inline constexpr float kNearestLens = 0.05F;

// --- inliers ---

/// share of tangents that are good, N(0, sigma). Tuning table.
inline constexpr float kInlierShare = 0.9F;
/// m within which outliers lie, evenly. Tuning table.
inline constexpr float kOutlierReach = 0.3F;
/// The same in sigmas; the larger of the two counts. Derived: there are outliers kGateSigmas times less dense than the
/// good ones at their peak, 1 / sqrt(2 pi).
inline constexpr float kOutlierSigmas = 2.5066283F * kGateSigmas;
/// likelihood of an outlier farther out than the model, against one inside it: pieces get lost far more often than
/// segments grow. The hybrid's; the cylinder, which has one radius for all sides, takes both alike. Tuning table, flat.
inline constexpr float kFartherOutliers = 0.25F;

// --- the cylinder ---

/// All ground rows of an object share one pitch error, so together they count as this many independent ones. Tuning
/// table, flat.
inline constexpr float kIndependentRows = 4.0F;
/// Bearing noise biases triangulated range towards the camera, most of all on a straight approach. Edges overrule the
/// rows only if they know the range this many times better than that bias would. Tuning table.
inline constexpr float kTrueDepth = 50.0F;
/// share of the way, one sigma of it: odometry, the focal length and the straightness of the line. Tuning table, flat.
inline constexpr float kTravelError = 0.02F;
/// Rows are judged by how fast their depths shrink while the robot comes nearer. They are true once that is known to
/// this share. Derived: the gate of the robot's own error.
inline constexpr float kTrendSigma = kGateSigmas * kTravelError;
/// m by which a foot wanders on the object while the robot passes it. Hazard table (bases; approaches for false stops).
inline constexpr float kFootWanders = 0.004F;
/// Sine of the maximum bearing at which rows are judged. The object may be seen from another side by as much. Its
/// nearest point is still the same then. Tuning table.
inline constexpr float kSameSide = 0.35F;
/// share of the distance beyond which the rows are wrong. Hazard table (bases; approaches for what it costs).
inline constexpr float kMinTrend = 0.10F;
/// Minimum ratio of the true depth to a row's; its inverse is the maximum. Tuning table, flat.
inline constexpr float kMinTrueShare = 0.4F;
/// share of the distance: the distance is unknown while its sigma exceeds it, and a first one by the row is known
/// to it. Drift study.
inline constexpr float kMaxDistanceSigmaShare = 0.25F;
/// m. A larger radius is a contradiction, not an obstacle of a small robot. Tuning table, flat.
inline constexpr float kLargestRadius = 1.5F;
/// Gain of the running means: of agreement, for each tangent, and of landmarks' surprises. Tuning table.
inline constexpr float kAgreementGain = 1.0F / 16.0F;
/// Mean agreement below which the past is forgotten. Tuning table, flat.
inline constexpr float kAgreementFloor = 0.35F;
/// Factor on past information in each view with such an agreement. Tuning table, flat.
inline constexpr float kForgetting = 0.8F;
/// 1/m^2. Information is halved beyond this, so that thousands of views neither freeze the estimate nor lose digits.
/// Derived: from 2^24 on, a float loses a weight of 1.
inline constexpr float kMaxInformation = 1 << 24;

}  // namespace fencepost::recon
