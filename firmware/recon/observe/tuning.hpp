// Numbers of observation that were chosen and not derived. "Stream": a rule for all readers of a record stream.
// "Tuning table": half and twice the value are not clearly better (tests/results/tuning.md). "Flat": nor worse.
#pragma once

#include <cstdint>

#include "hal/base/units.hpp"

namespace fencepost::recon {

// --- what all rooms share ---

/// Frames or views that must show a thing before anything relies on it: fewer may be noise. As `confirm.k` by default.
/// Tuning table.
inline constexpr std::uint8_t kFewestViews = 3;
/// Sigmas of the gate, beyond which a measurement disagrees with its prediction. More: swaps between objects; less:
/// objects seen double. Tuning table.
inline constexpr float kGateSigmas = 3.0F;
/// sigmas. Noise seldom reaches this far; beyond it a measurement counts less. Real runs, as Huber's tails.
inline constexpr float kUsualSigmas = 2.0F;
/// sigmas from which a systematic error is known: odometry drifts, rows are wrong. Less: noise counts as one; more: it
/// is known late. Real runs; hazard table (bases; approaches for what it costs).
inline constexpr float kKnownSigmas = 4.0F;
/// sigmas. Noise does not reach this far in a whole run. Tuning table, flat.
inline constexpr float kSurelySigmas = 5.0F;
/// Time for which the last state is assumed to hold: a gap in odometry is bridged, an object is still in view. A state
/// that lasts longer is taken as a fact: the robot is stationary, an object is missing. Tuning table.
inline constexpr base::Duration kMoment = base::milliseconds(500);
/// Maximum time that one frame adds to what is missing. An object that was missed for kMoment, by at least five frames,
/// is refuted. Less: alerts end when a camera misses; more: ghosts. Tuning table.
inline constexpr base::Duration kMissedByOneFrame{kMoment.raw / 5};
/// Time after which what is out of sight may have changed. Floor is then not known to be free any more. A confirmed
/// object makes room in a full table. Tuning table, flat.
inline constexpr base::Duration kOutOfSight = base::milliseconds(5000);

// --- the image ---

/// px. An end so close to the border is on it. Rows that differ by no more say nothing: both are whole pixels. Stream.
inline constexpr std::int16_t kBorderPixels = 1;
/// Newton steps that invert the distortion: |k1| r^2 < 0.3 converges to float precision in four. Derived, one to spare.
inline constexpr int kUndistortSteps = 5;

// --- time ---

/// Maximum time that a frame waits for the odometry at its exposure. By design: a rule of the stream.
inline constexpr base::Duration kMaxWait = base::milliseconds(200);
/// Maximum number of frames that wait. Stream.
inline constexpr std::size_t kMaxWaitingFrames = 4;

// --- how well edges and poses are known, one sigma each; too large costs little, too small does ---

/// px of a camera with kNoiseColumns columns or more. A setting overrides it (`camera.noise`). Tuning table.
inline constexpr float kEdgeNoise = 1.2F;
/// Columns below which the sigma falls with them: a pixel is wider there than the ragged edge of a segment. Tuning
/// table, flat.
inline constexpr float kNoiseColumns = 160;
/// px, below which it does not fall. Tuning table, flat.
inline constexpr float kMinEdgeNoise = 0.75F;
/// px. Two blobs this close touch, and a blob this close to the border: whole pixels of both, and the gate of an edge.
/// Nothing is expected to be visible so close to the image's sides.
/// More: true edges are given up; less: a neighbour's edge counts as the object's own. Derived; the identity study
/// agrees (4 % of the edges given up, 0 % taken wrongly, without noise).
inline constexpr int kTouchPixels = 2 * kBorderPixels + static_cast<int>(kGateSigmas * kEdgeNoise);
/// px. Within this of a neighbour an end is ambiguous. Too large costs little, since a lower bound is left. Derived:
/// the same with the gates of both edges.
inline constexpr int kBesidePixels = 2 * kBorderPixels + 2 * static_cast<int>(kGateSigmas * kEdgeNoise);
/// px, minimum width and height of a box that is clearly seen: the next frame from the same place shows it, too.
/// Derived: kSurelySigmas of an edge on either side.
inline constexpr auto kClearPixels = static_cast<std::int16_t>(2 * kSurelySigmas * kEdgeNoise);
/// px, of a box's bottom row. Tuning table.
inline constexpr float kRowNoise = 1.0F;
/// rad, of the heading at one exposure of a driving robot. Tuning table.
inline constexpr float kHeadingNoise = 0.0070F;
/// m, of the position at one exposure of a driving robot. Tuning table.
inline constexpr float kPositionNoise = 0.004F;
/// 10 um. A robot that has moved by no more is stationary; farther off than that, kFewestViews exposures in a row are
/// no noise. Derived: kSurelySigmas of a position.
inline constexpr auto kStandingNear = static_cast<std::int32_t>(1e5F * kSurelySigmas * kPositionNoise + 0.5F);
/// urad. The same of turning. Derived likewise.
inline constexpr auto kStandingTurn = static_cast<std::int32_t>(1e6F * kSurelySigmas * kHeadingNoise + 0.5F);
/// rad, of the camera's pitch, the same in every view: 0.3 degrees. Tuning table.
inline constexpr float kPitchNoise = 0.0052F;
/// share of the radius by which real footprints differ from a circle. Half of it is over-confident. Tuning table.
inline constexpr float kRoundness = 0.2F;

// --- ground rows ---

/// m. No object is assumed nearer than this, or expected in the image: it would fill it. Tuning table.
inline constexpr float kNearestObject = 0.1F;
/// m. Rows farther than this say more about the pitch than about the object. No distance is guessed beyond, and no
/// object is expected there. Wrong depths stay inside the square in which models live. Tuning table.
inline constexpr float kRowMaxDepth = 2.5F;
/// Mean depth of an unseen foot, as a share of the depth at which feet leave the image. Very near objects fill the
/// image and have no edge at all, so the far half is likelier. Tuning table.
inline constexpr float kHiddenFootMean = 0.75F;
/// Its sigma, as a share of the same depth. Derived: sqrt(3 / 80), of a density with that mean that grows with the
/// square of the depth.
inline constexpr float kHiddenFootSigma = 0.19365F;

}  // namespace fencepost::recon
