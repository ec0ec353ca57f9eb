// Numbers of the hybrid that were chosen and not derived. "Hybrid table": tests/studies/tables, hybrid_table, chosen on
// its tuning seeds 5001 to 5060 and judged on others.
// "Tuning table": half and twice the value are not clearly better (tests/results/tuning.md). "Flat": nor worse.
// Equations: firmware/recon/EQUATIONS.md, part 5.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/models/tuning.hpp"

namespace fencepost::recon {

// --- views (hybrid, tangent) ---

/// Minimum move of the lens for a view to count as new, as a share of a whole view's (kNovelShare). Tuning table, flat.
inline constexpr float kMinNewView = 0.25F;
/// m by which an end outside the image has to be beyond the outline to count as new. Tuning table.
inline constexpr float kOutgrown = 0.03F;
/// m, minimum width of the seen part of an object that goes on. Its foot is then that of the part in the image alone.
/// Tuning table.
inline constexpr float kGoesOn = 0.3F;
/// share of that width by which its foot is off if it goes on straight, but aslant. Extent table.
inline constexpr float kTilt = 0.2F;
/// m, half the side of the square that outlines are cut out of. Derived: of the largest, whose origin is on its rim.
inline constexpr float kOutlineSquare = 2 * kLargestRadius;
/// m by which an outline that is known well is moved in, at most: sigmas of large ones say how far a series is off.
/// Tuning table.
inline constexpr float kMaxInward = 0.004F;
/// share of the radius beyond which a larger sigma moves an outline no farther out. Hybrid table.
inline constexpr float kVagueShare = 2.0F;
/// sigma as a share of the radius below which an outline is known well: to be drawn and measured by. Tuning table,
/// flat.
inline constexpr float kWellKnownShare = 0.4F;

/// m, sigma of the distance by which a foot is set back from the outline above it. Real things are narrower below,
/// rounded or not quite on the floor. All rows of an object share the error of one pitch and one height. More: the
/// distance is open on a straight approach; less: rows outvote the edges of a ring. Path table, seeds 5001 to 5024, and
/// a ring of images.
inline constexpr float kFootSetBack = 0.02F;

// --- clusters of tangents (sector_store) ---

/// sigmas within which a tangent joins a cluster. Tuning table.
inline constexpr float kJoinSigmas = 2.5F;
/// share of its own weight that a newcomer which agrees with nothing takes from the weaker cluster. Tuning table, flat.
inline constexpr float kWeakening = 0.5F;
/// A cluster farther out by two sigmas overrules another from this share of the other's views on. More: wrong cuts
/// stay; less: noise adds to the outline. Tuning table, flat.
inline constexpr float kOverrulingShare = 0.35F;
/// Share of its views that an overruled cluster counts for; more and less as above. Hybrid table.
inline constexpr float kOverruled = 0.5F;
/// views that a cluster remembers; older ones fade. Derived: a byte's worth of eighths, less one view to come.
inline constexpr float kMaxClusterViews = 255 / 8.0F - 1;

// --- solvers (cyclic_band, low_order_fit) ---

/// share of its own diagonal below which a pivot is rounding. Derived: a float's, 2^-24, in half of the ring's sums.
inline constexpr float kMinPivot = 32.0F / (1 << 24);

// --- the series of low order (low_order_fit) ---

/// m, sigma of the local origin as the centre. Tuning table.
inline constexpr float kCenterSigma = 2.0F;
/// of r / (m^2 - 1), the prior of order m. More: with few views an outline takes noise for shape; less: long things are
/// drawn round. Hybrid table, and cars of the KITTI study.
inline constexpr float kShapeShare = 0.5F;
/// m, smallest radius that scales priors, and with which sigmas are compared. Tuning table, flat.
inline constexpr float kMinRadius = 0.015F;
/// m, largest radius that scales priors: of the higher orders, and of sides. Tuning table, flat.
inline constexpr float kLargestPrior = 0.4F;

// --- what is large (both fits) ---

/// m, radius up to which a series of low order is off by no more than tangents are. Tuning table, flat.
inline constexpr float kFitsAny = 0.2F;

// --- the polygon (support_fit) ---

/// A side is known to kSideSigma r sqrt(D) before anything is seen, where tangents come from all around. Hybrid table.
inline constexpr float kSideSigma = 1.8F;
/// Share of kSideSigma that each tangent adds: an outline seen from one side is rather as objects are. Hybrid table.
inline constexpr float kSharePerTangent = 1.0F / 56.0F;
/// Share of kSideSigma with the fewest tangents. Hybrid table.
inline constexpr float kMinSideShare = 0.45F;
/// Softening of the weight of a side of length l relative to a round outline's side D r: D r / (l + kSoftening D r).
/// Tuning table.
inline constexpr float kSoftening = 0.3F;
/// Share of D r above which a side is drawn to the length D r; a shorter one is drawn to zero. Tuning table.
inline constexpr float kLongSide = 0.5F;
/// relative weight against sides of negative length, which are no sides. Tuning table.
inline constexpr float kStiffness = 100.0F;
/// m, sigma of the prior that holds the polygon at the low order's fit. It decides only what neither tangents nor sides
/// determine, such as the middle if all tangents are parallel. Tuning table.
inline constexpr float kHold = 0.15F;

// --- how a fit narrows down (hybrid_solver, inlier) ---

/// Factor on the sigmas in each pass of the low order. Tuning table.
inline constexpr std::array<float, 7> kLowOrderPasses = {8, 4, 2, 1.4F, 1, 1, 1};
/// The same of the support fit. Derived: all but the first, which the low order has taken.
inline constexpr std::span<const float, kLowOrderPasses.size() - 1> kSupportPasses =
    std::span(kLowOrderPasses).last<kLowOrderPasses.size() - 1>();
/// pass of the support fit from which sides are weighed. Tuning table.
inline constexpr std::size_t kPolygonalFrom = 2;
/// The spread is learnt in passes no wider than this. Derived: of those in which sides are weighed.
inline constexpr float kLearningWidening = kSupportPasses[kPolygonalFrom];
/// Tangents from which on the spread is learnt. Derived: as many as a series of order 3 has unknowns.
inline constexpr std::uint8_t kTangentsForSpread = 1 + 2 * 3;
/// Factor on variances with which a fit begins: twice the sigmas, for the accuracy of camera and wheels is unknown.
/// Sigmas that are too small cost far more than those that are too large. Hybrid table.
inline constexpr float kFirstSpread = 4.0F;
/// views it takes to see a polygon. Hybrid table.
inline constexpr std::uint8_t kViewsForPolygon = 8;
/// floating-point operations of a step, roughly, before it ends: on a core without a floating-point unit some 30,000
/// instructions, at most 50,000. By design: a slice of the smallest part's frame.
inline constexpr int kWorkPerStep = 500;
/// Parts of a whole view in which the weight of new views is counted. Derived: a view of kMinNewView has eight parts,
/// and rounding changes its weight by a sixteenth at most.
inline constexpr auto kWholeView = static_cast<int>(8 / kMinNewView);
/// Passes of a warm fit, the last ones of series and of support: it begins from the outline that is there. More:
/// outlines of boards are older; fewer: what a first fit got wrong stays. Lap at 0.15 m/s and 10 frames/s, level 2,
/// seeds 71001 to 71030.
inline constexpr std::size_t kWarmPasses = 2;
/// Each so manyth fit begins from nothing, for what a warm one cannot leave. Same study.
inline constexpr std::uint8_t kWholeFitEvery = 8;
/// m. The middle of the outline may be this far from the local origin before that follows it. Tuning table.
inline constexpr float kRecentre = 0.02F;

}  // namespace fencepost::recon
