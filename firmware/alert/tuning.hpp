// Numbers of the alerts that were chosen and not derived. "Alert study": tests/studies/alerts, on the seeds that its
// README names for tuning. "By design": no study was made for the value. What a user may set is in
// firmware/config/settings.hpp.
#pragma once

#include <cstdint>

#include "firmware/recon/guard/tuning.hpp"
#include "firmware/recon/models/tuning.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "firmware/recon/track/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::alert {

/// Maximum time between two looks at the path, with frames or without. More: late stops; less: instructions. By design.
inline constexpr base::Duration kWatchInterval = base::milliseconds(100);
/// s. Derived: the same.
inline constexpr float kLookSeconds =
    static_cast<float>(kWatchInterval.raw) / static_cast<float>(base::Duration::kPerUnit);
/// s from a look at the path until a robot that obeys the speed limit is seen to be slower. More: slow robots; less:
/// stops of robots that obey. By design: 0.1 s to watch, 0.2 s for the motors, 0.1 s for odometry.
inline constexpr float kSlowsWithin = 0.4F;
/// A level eases only when the obstacle is farther than its threshold by this factor. More: stale alerts; less: alerts
/// that flicker. By design.
inline constexpr float kHysteresis = 1.15F;
/// And for this long. Derived: as long as refutes a point of the guard.
inline constexpr base::Duration kEaseAfter = recon::guard::kRefutedAfter;
/// Minimum time between two notices of an alert: a notice is not urgent. By design.
inline constexpr base::Duration kNoticeInterval = base::milliseconds(1000);
/// Change of distance after which an alert in force is said again in words. Derived: twice the centimetre that is
/// shown, so that jitter about a half does not repeat it.
inline constexpr base::Metres kSaidAgain{200};

/// Safety margin for the uncertainty of a distance: it is subtracted before the comparison with the stop distance.
struct Margin {
  float sigmas;
  float most;  ///< as a share of the stop distance: uncertainty must not stop a robot far from anything
};
/// Margin of an object that was seen whole. More: false stops; less: late ones. Alert study.
inline constexpr Margin kSeenWhole{3.0F, 0.2F};
/// Margin of one with an unseen end: it may extend much nearer than its cylinder. More and less as above. Alert study.
inline constexpr Margin kCutOff{4.0F, 0.4F};

/// m by which the guard's points (recon/guard) count as nearer. More: false stops. Derived: the gate of the pose's
/// position.
inline constexpr float kFrontDoubt = recon::kGateSigmas * recon::kPositionNoise;
/// m, outermost part of the margin in which they do not count. More: late stops; less: false ones (0.02: 5 more in 81
/// minutes; 0.04: 4 fewer). Alert study.
inline constexpr float kUnsureMargin = 0.03F;

// --- what comes closer by itself (looming); hazard table, families movers and approaches, seeds 1 to 200, where
// nothing else is said ---

/// quarters of a row: sigma of a foot's row. More: late stops; less: noise moves. Derived: as matching has it.
inline constexpr auto kRowSigma = static_cast<std::int32_t>(4 * recon::kRowPixels);
/// mm, sigma of a depth besides that of the row. Derived: that of the way between two positions of the robot.
inline constexpr auto kDepthSigma = static_cast<std::int32_t>(1414.2F * recon::kPositionNoise + 0.5F);
/// quarters of a column: sigma of a width. By design.
inline constexpr std::int32_t kColumnSigma = 9;
/// Gate of a depth, in squared sigmas; recon::kFewestViews outliers in a row begin anew. By design.
inline constexpr std::int32_t kDepthGate = 16;
/// mm^2/s^3, process noise of a thing's own speed. More: slow things are found late; less: things that brake or start
/// are followed late.
inline constexpr std::int32_t kUnsteady = 10'000;
/// mm^2/s^2, of a thing seen for the first time. By design: 1 m/s.
inline constexpr std::int32_t kFirstSpeedVariance = 1'000'000;
/// mm/s, maximum lateral speed of a track with one sighting. By design.
inline constexpr std::int32_t kFastestThing = 1500;
/// 2^-14, lateral gate of a box besides half of its width. By design.
inline constexpr std::int32_t kSideGate = 600;
// A track approaches by itself if its own speed exceeds kSureSigmas, and kMinOwn and kOwnShare together, in kSureFrames
// frames in a row. A foot above the floor, or a wrong pitch, seems to move with the robot. More: late stops; less:
// false ones.

/// Sigmas of the speed. Derived: the gate of everything.
inline constexpr auto kSureSigmas = static_cast<std::int32_t>(recon::kGateSigmas);
/// The same once it is known to come. Derived likewise.
inline constexpr auto kStillSigmas = static_cast<std::int32_t>(recon::kUsualSigmas);
/// Share of the robot's speed, in sixteenths.
inline constexpr std::int32_t kOwnShare = 6;
/// Frames in a row.
inline constexpr std::uint8_t kSureFrames = 4;
// Thresholds for calling a track moving, which takes it out of the map. Higher: ghosts; lower: stationary things have
// no model.

/// Minimum axial speed, in halves of its sigma.
inline constexpr std::int32_t kMovedSigmas = 3;
/// mm/s. Minimum axial or lateral speed.
inline constexpr std::int32_t kMinMoved = 70;
/// Minimum axial speed of a track that recedes, in sixteenths of the robot's speed.
inline constexpr std::int32_t kMovedShare = 10;
/// The same of a track that approaches. Derived: wrong rows make stationary things approach; a foot at half the height
/// of the lens does so at the robot's own speed.
inline constexpr std::int32_t kNearingShare = 16 + kMovedShare;
/// log2: lateral speed has to exceed kMinMoved by depth / 2^this each second.
inline constexpr int kMovedDepthShareLog2 = 3;
/// mm/s. Maximum speed of a stationary robot: odometry is noisy. Of a faster one only what is known in scale counts.
/// Hazard table.
inline constexpr std::int32_t kRobotWavers = 60;
/// mm/s. Minimum own speed of a thing that approaches by itself. Derived: the robot's speed is known no better.
inline constexpr std::int32_t kMinOwn = kRobotWavers;
/// 2^-14. Maximum slope of a track that is ahead.
inline constexpr std::int32_t kAheadSlope = 2500;
/// Frames with motion, less those without, that make a track moving. The count ends at three times as many.
inline constexpr int kMovedFrames = 8;

/// Consecutive sightings with both ends before a width gives a distance. By design.
inline constexpr std::uint8_t kWholeSightings = 2;
/// Frames over which the robot's speed is averaged, and sightings over which a width is. By design.
inline constexpr std::int32_t kAveragedFrames = 8;
/// Time span of the sightings for the direction and its change. More: things that turn are followed late; less: things
/// that pass beside stop the robot. By design.
inline constexpr base::Duration kDirectionSpan = base::milliseconds(700);
/// Least number of these sightings, and of those before lateral speed is used. Derived: recon::kFewestViews for the
/// direction, and as many for its change.
inline constexpr std::int32_t kMinSightings = 2 * recon::kFewestViews;
/// Most of them. By design.
inline constexpr std::int32_t kMaxSightings = 32;
/// mm. What is farther is not followed. More: work for what cannot matter; less: what is fast is found late. Derived:
/// twice as far as the guard's points.
inline constexpr std::int32_t kFarthestFollowed = 2 * recon::guard::kFarthest;
/// mm. Nearer depths count as this one. Derived: as the models have it.
inline constexpr auto kMinDepth = static_cast<std::int32_t>(1000 * recon::kNearestLens + 0.5F);
/// mm, assumed width of a thing that a camera without a known pitch shows clearly. By design.
inline constexpr std::int32_t kGuessedWidth = 100;
/// Time after which an unseen track is deleted; all are after a pause of recon::kMoment. Derived: as long as refutes a
/// point of the guard.
inline constexpr base::Duration kUnseen = recon::guard::kRefutedAfter;
/// The same for a track that approaches below the image. Derived: three times as long.
inline constexpr base::Duration kComesUnseen{3 * kUnseen.raw};
/// Time after which a track without a measured distance is deleted. Derived: as a point of the guard without support.
inline constexpr base::Duration kUnmeasured = recon::guard::kUnconfirmed;
/// Share of alert.ttc_stop by which the time to contact counts as shorter at most; else by kUsualSigmas. More: false
/// stops; less: late ones.
inline constexpr float kMaxEarly = 0.4F;

/// Quarters of its usual interval after which an input is overdue, within the three bounds that follow. More: blindness
/// is not reported; less: it is reported of a camera that skips a frame. By design.
inline constexpr std::int64_t kOverdueQuarters = 10;
/// Minimum of that time. Derived: the time that safety.md promises, less a turn of the loop.
inline constexpr base::Duration kMinOverdue = base::milliseconds(270);
/// Maximum of that time. By design.
inline constexpr base::Duration kMaxOverdue = base::milliseconds(1500);
/// Minimum of that time for a stationary robot. Derived: nothing that it sees is forgotten sooner.
inline constexpr base::Duration kOverdueStanding = recon::kKeepUnseen;
/// Time without any change of the boxes after which the camera is frozen, if kFrozenShift was expected. By design.
inline constexpr base::Duration kFrozenFor = base::milliseconds(200);
/// px, sum of what the robot's motion should have moved the boxes' edges by meanwhile. Derived: by chance no edge of a
/// live camera changes in one case of e^8 = 3,000. At 4, noiseless runs had false reports (approaches, seeds 1 to 400).
inline constexpr float kFrozenShift = 8;
/// Maximum interval between two images of a camera to drive by. A camera that is polled faster than it sees repeats its
/// images; its boxes may then stay for a quarter more than its last interval. Derived: with longer intervals tracks
/// would be deleted between two images.
inline constexpr base::Duration kSlowestImage = kUnseen;
// A step between two samples that is longer than any robot's is a jump. The pose is then not used for recon::kMoment.

/// m. Part of the longest step that does not grow with time. By design.
inline constexpr float kStepJump = 0.1F;
/// m/s. Part that does. By design.
inline constexpr float kFastest = 5;
/// Minimum time between two reports of blindness while the robot is stationary: a user may be typing. By design.
inline constexpr base::Duration kStandingBlind = base::milliseconds(10'000);
/// Time without a blob after which a camera is `empty`. Derived: as an input is overdue for a stationary robot.
inline constexpr base::Duration kEmptyAfter = kOverdueStanding;

/// m/s. A slower robot is stationary. By design.
inline constexpr float kStanding = 0.01F;
/// m/s, minimum closing speed. Derived: half of what the robot may creep.
inline constexpr float kNotClosing = kStanding / 2;
/// m/s. Below this speed, odometry with 5 mm of jitter gives the direction no better than by chance. The robot then
/// counts as going straight and on its arc, ahead and back. More: a robot that backs off slowly gets alerts of what is
/// ahead; less: a stationary one gets a clear now and then. Hazard table.
inline constexpr float kSurelyMoving = 0.08F;
/// rad/s. Minimum turn rate of an arc at such a speed: half a degree of jitter is less. By design.
inline constexpr float kSurelyTurning = 0.15F;
/// rad/s, minimum turn rate of a spin, of a robot that hardly drives. A thing beside it is then in its way until it
/// drives on. More: a robot that stops in a slow spin gets a clear; less: jitter of odometry turns a stationary one.
/// Derived: twice kSurelyTurning.
inline constexpr float kSpinning = 2 * kSurelyTurning;
/// 2^-14 rad/s. Maximum turn rate of a robot that drives straight or is stationary. Derived: a slower one has no arc.
inline constexpr auto kRobotStraight = static_cast<std::int32_t>((1 << 14) * kSurelyTurning);
/// m, minimum radius of an arc: tighter, the robot turns on the spot. By design.
inline constexpr float kTightestArc = 0.15F;
/// m, maximum radius of an arc: flatter, the robot drives straight. By design.
inline constexpr float kFlattestArc = 50.0F;

/// rad. Part of the largest turn between two samples that does not grow with time. Derived: wheels on the tightest arc
/// make such a turn of a step.
inline constexpr float kTurnJump = kStepJump / kTightestArc;
/// rad/s. Part that does. Derived likewise.
inline constexpr float kFastestTurn = kFastest / kTightestArc;
/// rad/s. A robot that turns more slowly is stationary. Derived likewise.
inline constexpr float kNotTurning = kStanding / kTightestArc;

// --- the check of the camera's configuration ---

/// Objects whose rows are wrong to the same side before the camera is to blame: fewer may stand on bases. By design.
inline constexpr unsigned kDoubtfulObjects = 3;
/// Their mean factor from which on the camera is to blame, where things are nearer than rows say. Less: complaints
/// about ragged feet; more: two degrees of pitch, which make 1.45 or 1.5, are missed. Hazard table (cameras), seeds 1
/// to 40, levels 2 and 3.
inline constexpr float kMinNearer = 1.25F;
/// The same where things are farther, which noise feigns more easily and which only makes alerts come early.
inline constexpr float kMinFarther = 1.45F;
/// Maximum factor by which alerts widen their distances after a failed check. By design.
inline constexpr float kMaxCaution = 2.0F;
/// Counts of 0.01. A factor is reported again once it has changed by this. Less: the same said again. By design.
inline constexpr std::int32_t kDoubtStep = 10;

}  // namespace fencepost::alert
