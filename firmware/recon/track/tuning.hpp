// Numbers of tracking that were chosen and not derived.
// "Tuning table": half and twice the value are not clearly better (tests/results/tuning.md). "Flat": nor worse.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon {

// --- which blob is which object (prediction, correspondence) ---

/// rad. An end may be off by this for reasons outside the noise model: loose mounts, wheel slip. More: swaps between
/// neighbours; less: objects lost after a bump. 3 degrees. Tuning table.
inline constexpr float kSlackRadians = 0.05F;
/// share of the predicted width by which a lost or grown piece of a segment moves an end: segments lose up to half.
/// Tuning table.
inline constexpr float kGateWidthShare = 0.5F;
/// rad by which an object may go on behind a neighbour or the border: 15 degrees. Tuning table, flat.
inline constexpr float kHiddenRadians = 0.26F;
/// share of the image's width, sigma of an end that may be anywhere in it. Even where the end is predicted a blob is
/// then likelier something new, unless what was out of view is alone of its colour. 1 / sqrt(2 pi): a normal's highest
/// density is that of the whole width there. Derived.
inline constexpr float kSomewhere = 0.399F;
/// px, sigma of rows besides that of distance and pitch: whole pixels, rounded edges. Tuning table.
inline constexpr float kRowPixels = 1.5F;
/// relative change of depth between sightings that the rows of an object without a distance are expected to show.
/// Tuning table, flat.
inline constexpr float kRowChange = 0.15F;
/// cost units of a pair that is wrong on all four sides: the unit of costs. Derived: twice as much hardly fits a byte.
inline constexpr float kCostScale = 200.0F;
/// cost units, least cost of an object whose distance is unknown: any well-placed one goes first. Derived: two of its
/// sides are wrong.
inline constexpr float kUnknownCostNear = kCostScale / 2;
/// Worst cost of the same. Derived: three of its sides are wrong.
inline constexpr auto kUnknownCost = static_cast<std::uint8_t>(kCostScale * 3 / 4);
/// share of a side's cost where the side is hidden or not predicted: it speaks neither for a pair nor against it.
/// Derived: the square of half a gate.
inline constexpr float kCostOfUnknownSide = 0.5F * 0.5F;
/// cost units. A blob that stays unmatched; a dearer pair is not made. More: swaps; less: doubles. Tuning table.
inline constexpr std::uint8_t kUnmatchedCost = 160;
/// Ids that stay for one that changes, of a camera that tracks, before it has shown its own odds. Derived from
/// published trackers: they change the id of one box in 60 to 160 (SORT on MOT17, StrongSORT on MOT16).
inline constexpr std::uint8_t kIdsKept = 64;
/// cost units of odds of 2 to 1. Derived: a side's cost is a normal's log-likelihood, kCostScale / 4 at the gate.
inline constexpr auto kCostOfOctave =
    static_cast<std::uint8_t>(0.6931F * kCostScale / (2 * kGateSigmas * kGateSigmas) + 0.5F);
/// Ratio of depths above which models do not decide which of two is in front. Tuning table, flat.
inline constexpr float kSameDepth = 0.95F;

// --- life cycle (object_table) ---

/// frames in a row in which one end is off and the other is not: the models are of something else. Tuning table, flat.
inline constexpr int kContradictingFrames = 10;
/// px, gate of a foot's row while the robot is stationary, lost pieces left aside. Derived: the gates of both rows.
inline constexpr auto kFootJump = static_cast<int>(2 * kGateSigmas * kRowNoise);
/// Presence is averaged over about this many expected sightings, as its inverse. Tuning table, flat.
inline constexpr float kPresenceGain = 1.0F / 8.0F;
/// sigmas. A foot's predicted row is inside the image with these to spare. A blob stands clearly behind it if its foot
/// is higher by these. Derived: kUsualSigmas.
inline constexpr auto kFootSigmas = static_cast<int>(kUsualSigmas);
/// Views. A refuted object with fewer is deleted. One with more stays, and only its alerts stop, for real cameras miss
/// known objects in more frames than refute one. Tuning table.
inline constexpr std::uint32_t kFewViews = 8;
/// Time before a mover of its colour is known within which an object's last sighting may have been that mover. More:
/// static objects are forgotten; less: ghosts. Derived: kFewestViews sightings, each at most kMoment after another.
inline constexpr base::Duration kTrail{kFewestViews * kMoment.raw};
/// Minimum time for which an object is kept, whatever contradicts it. Derived: twice what refutes it.
inline constexpr base::Duration kKeepUnseen{2 * kMoment.raw};

}  // namespace fencepost::recon
