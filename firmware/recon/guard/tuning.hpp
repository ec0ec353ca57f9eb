// Numbers of the guard that were chosen and not derived. "Alert study": tests/studies/alerts, level 2, seeds 1 to
// 1,000. "Flat": in that study, half and twice the value changed the stops in time (940 obstacles) by at most one. They
// changed the false stops by at most three; the round number is kept.
// "Tuning table": tests/results/tuning.md, where neither half nor twice the value is clearly better.
#pragma once

#include <cstdint>

#include "firmware/recon/guard/front.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon::guard {

// --- where a front is ---

inline constexpr int kSpacingLog2 = 6;  ///< log2 of kSpacing
/// mm between neighbouring points of one front. No strip of floor of this width passes between two. Derived
/// from its logarithm.
inline constexpr std::int32_t kSpacing = 1 << kSpacingLog2;
/// mm along the optical axis. A front that is farther is not kept: its row says little. Tuning table.
inline constexpr std::int32_t kFarthest = 1500;
/// mm. Points farther from the robot are deleted. Odometry drifts by less than a robot's margin on such a way. Tuning
/// table, flat.
inline constexpr std::int32_t kForgotten = 2000;
/// Assumed depth of an unseen foot, in 1/16 of the nearest visible depth. Higher: late stops at what was never seen
/// whole; lower: false ones (14: two fewer in 81 minutes). Derived: as the models have it.
inline constexpr auto kUnseenFoot = static_cast<std::int32_t>(16 * kHiddenFootMean);
/// mm by which a front goes on beyond the side of the image that cuts it. More: false stops in corridors; less: late
/// ones at walls. Derived: to the next point.
inline constexpr std::int32_t kBeyondSide = kSpacing;

// --- which sighting means which point ---

/// mm of the gate in depth within which a sighting supports a point; kSupportRows adds to it. Alert study.
inline constexpr std::int32_t kSupportSlack = 15;
/// Quarters of a row of the same gate. More: two things count as one; less: doubles, and false stops (6: 11 more in 81
/// minutes). Alert study.
inline constexpr std::int32_t kSupportRows = 10;
/// mm beyond a point from which a blob's foot refutes it; kPastRows adds to it. More: stale points; less: noise
/// refutes. Derived: 5 mm more than supports.
inline constexpr std::int32_t kPastSlack = kSupportSlack + 5;
/// Quarters of a row of the same threshold. Derived: one row more than supports.
inline constexpr std::int32_t kPastRows = kSupportRows + 4;
/// px on either side by which a blob may be narrower than what it shows. Derived: two sigmas of an edge.
inline constexpr auto kEdgePixels = static_cast<std::int32_t>(kUsualSigmas * kEdgeNoise);
/// mm to the side. Derived: a quarter of the way to the next point.
inline constexpr std::int32_t kSideSlack = kSpacing / 4;
/// mm, minimum step of a supported point, which takes half of it. Derived: one sigma of the position.
inline constexpr auto kMinStep = static_cast<std::int32_t>(1000 * kPositionNoise + 0.5F);

// --- how long ---

/// Time for which frames have to look past a point, in at least three of them, before it is deleted. Support counts
/// twice against it. More: stale alerts; less: alerts that end because a camera misses a blob. Derived: kFewestViews
/// times what one frame adds, which is as of an object.
inline constexpr base::Duration kRefutedAfter{kFewestViews * kMissedByOneFrame.raw};
/// Of the frames that show neither support nor floor behind a visible point, one in this many counts against it. A
/// power of two. Derived: one in each round of the frames that a point remembers.
inline constexpr unsigned kUnsureFrames = kRememberedFrames;
/// Time without support after which a point that fewer than kFewestViews frames have supported is deleted. The last
/// position of a foot that left the image is kept for as long. More: noise below the image adds up; less: slow cameras
/// see nothing. Flat.
inline constexpr base::Duration kUnconfirmed = base::milliseconds(2000);
/// log2 of the tolerance, a fraction of the nearest visible depth, for matching an unseen foot to its last position in
/// the image. Flat.
inline constexpr std::int32_t kCutReachLog2 = 3;

/// Points that a frame may put in the place of less useful ones when all are in use: bounds its work. Tuning table,
/// flat.
inline constexpr int kMaxReplaced = 8;

}  // namespace fencepost::recon::guard
