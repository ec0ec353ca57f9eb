// Numbers of the pose correction that were chosen and not derived. "Drift study" and "tours": chosen on simulated tours
// and on the recording D7_R2 from eight starts, judged on others. "Real runs": chosen on the five robots of MRCLAM's
// data set 1 (real_drift_study) and on simulated loops of seeds 500 to 519. They were judged on data sets 4, 6 and 7.
// "Tuning table": half and twice the value are not clearly better (tests/results/tuning.md). "Flat": nor worse.
#pragma once

#include <cstdint>

#include "firmware/recon/models/hybrid/tuning.hpp"
#include "firmware/recon/models/tuning.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon {

// --- landmarks ---

/// factor on the variances of a cylinder that becomes a landmark: it took the same frames and the same poses for
/// independent. Derived: as a fit begins.
inline constexpr float kOverconfidence = kFirstSpread;
/// share of a first distance by a typical size, one sigma of it. Derived: that of the size.
inline constexpr float kSizeShare = kRadiusSigma / kTypicalRadius;
/// m, sigma of a first place beside its bearing. Drift study.
inline constexpr float kAcross = 0.03F;
/// sine of the half angle under which a landmark is seen, at most: the lens is not inside the circle. Tuning table,
/// flat.
inline constexpr float kWidestSine = 0.95F;

// --- the filter ---

/// share of each variance that is added in each update, to cover rounding: 1 % in ten thousand updates. Derived.
inline constexpr float kRounding = 1e-6F;
/// variance (m^2, rad^2) of the start, which defines the map frame. Zero would leave the first equations no margin.
/// Derived: the rounding of a variance of one.
inline constexpr float kStartVariance = kRounding;
/// sigmas. Farther off than this a tangent is not this landmark's. Beyond kUsualSigmas it counts less, as Huber has it.
/// A gate at the third loses loops for good, since nothing that is gated brings the pose back. Derived: noise does not
/// reach kSurelySigmas, and sigmas may be half of what they should be (kOverconfidence). Real runs agree.
inline constexpr float kFilterGateSigmas = 2 * kSurelySigmas;
static_assert(kOverconfidence == 2 * 2);
/// m and rad, maximum step by one tangent: a larger one means that the numbers are wrong. The filter's origin is no
/// farther from the robot. Tuning table, flat.
inline constexpr float kFarthestStep = 2.0F;

// --- drift and models ---

/// Adaptation gain of the odometry's process noise. Real runs.
inline constexpr float kDriftGain = 0.03F;
/// Clamp of a normalised squared innovation. Derived: the gate's square.
inline constexpr float kMaxSurprise = kGateSigmas * kGateSigmas;
/// Upper bound of the factor on the odometry's variances: a drift of 60 % where 3 % is configured. Tuning table, flat.
inline constexpr float kMaxDrift = 400.0F;
/// Way (m) or turn (urad) of the robot after which the filter takes the next frame.
struct LookInterval {
  float step = 0;
  std::int32_t turn = 0;
};
/// The interval of half as many looks.
constexpr LookInterval doubled(const LookInterval& interval) { return {2 * interval.step, 2 * interval.turn}; }
/// Limits of the correction's cost.
struct LandmarkPace {
  LookInterval believed;   ///< while odometry is believed
  LookInterval corrected;  ///< since it is not; a turn of -1: every frame
  /// An equation is left out if the prior variance of its bound is below this share of its own: it adds hardly
  /// anything.
  float min_share = 0;
  bool in_turns = false;  ///< width and foot: one of them each time
  /// Minimum of the sum, in squared sigmas, by which bearings fit the landmarks better than the odometry. Each bearing
  /// adds at most kMaxEvidence. Less: drift is seen where the pitch is wrong, where things hang above the floor, or
  /// where feet are far from the lens's axis. More: a drifting map for longer.
  float evidence = 0;
};
/// For profile full, that is desks and Linux. Tuning table. The evidence is from real runs and from seven drives of
/// KITTI, each with three pitches. With 24 two of these 21 are harmed, with 32 and 40 none.
inline constexpr LandmarkPace kPaceOfDesks{{0.04F, 80'000}, {0, -1}, 0, false, 32.0F};
/// For small profiles: half as many looks as on desks while odometry is believed, and as many as there afterwards.
/// Less evidence, for they give less. The share and the evidence: drift study with profile small, loops 500 to 529,
/// also with five times the frames.
inline constexpr LandmarkPace kPaceOfRobots{doubled(kPaceOfDesks.believed), kPaceOfDesks.believed, 0.02F, true, 6.0F};
/// Maximum evidence of one bearing, in squared sigmas, see LandmarkPace: real bearings have long tails. Derived: where
/// Huber's tails begin.
inline constexpr float kMaxEvidence = kUsualSigmas * kUsualSigmas;
/// Squared sigmas subtracted from the evidence of each bearing, because the filter may follow noise. Real runs.
inline constexpr float kEvidenceSlack = 0.1F;
/// Mean surprise from which on a landmark is something that moves: a jump of the pose is over before that. Derived:
/// where Huber's tails begin. Real runs, with the other robots.
inline constexpr float kStraying = kUsualSigmas * kUsualSigmas;
/// Factor on the sigma of where a landmark should appear that is alone of its colour. Wheels slip and are lifted, which
/// has longer tails than what the filter knows. Less: landmarks seen double after a blind stretch. Among likes so vague
/// a prediction would take any blob. Real runs.
inline constexpr float kLongTails = 3.0F;

/// m/sqrt(m) for each share by which distances of odometry are off: sigma of the position. Drift study.
inline constexpr float kDriftPosition = 0.4F;
/// rad/sqrt(m) for the same share: sigma of the heading. At 3 % it is 1.2 degrees after a metre. Turning, in
/// rad/sqrt(rad), is off by the share itself. Drift study.
inline constexpr float kDriftHeading = 0.67F;
/// rad, sigma of a corrected heading for the models: what is left of its error. Tuning table, flat.
inline constexpr float kCorrectedHeading = 0.0105F;
/// m, sigma of a corrected position. Derived: half as much again as of one that is believed, as of the heading.
inline constexpr float kCorrectedPosition = 1.5F * kPositionNoise;

// --- the check of the lens ---

/// urad of heading between the frames that are compared. More: objects leave the image before; less: the noise of
/// headings and edges counts more. Tuning table, flat.
inline constexpr std::int32_t kLensTurn = 150'000;
/// urad for each 0.1 ms, minimum turn rate: slower, odometry's rounding counts too much. Derived: kLensTurn in a
/// second.
inline constexpr auto kLensMinRate = static_cast<std::int32_t>(kLensTurn / base::Duration::kPerUnit);
/// 1/s. Share of a turn by which its rate may change between two frames. A latency that is wrong by 50 ms then changes
/// the turn by a tenth. Tuning table, flat.
inline constexpr float kLensSteady = 2.0F;
/// Maximum share of the turn that parallax may have, for the object's distance may be wrong. Derived: a known distance
/// may be off by the same share, and then the turn by a sixteenth.
inline constexpr float kLensMaxParallax = kMaxDistanceSigmaShare;
/// m, minimum distance of the object: nearer, the lens's place on the robot matters too much. Tuning table, flat.
inline constexpr float kLensNearest = 0.3F;
/// Factor beyond which a sample is an outlier. Tuning table, flat.
inline constexpr float kLensMaxOff = 2.5F;
/// rad, sigma of a sample, at least: edges, headings, and an object whose middle is not where its box has it. Tuning
/// table, flat.
inline constexpr float kLensSampleSigma = 0.015F;
/// Objects followed, or one twice, before the first verdict. Tuning table, flat.
inline constexpr std::uint8_t kLensObjects = 2;
/// Samples before the first verdict. Derived: two of each object.
inline constexpr std::uint8_t kLensMinSamples = 2 * kLensObjects;
/// Samples at which half is forgotten. Tuning table, flat.
inline constexpr std::uint8_t kLensMaxSamples = 64;
/// Thresholds of the factor and of its significance in sigmas. The focal length is wrong above kLensWrong, and right
/// again below kLensRight. Less: complaints about lenses that do no harm, and about wheels. Hazard table (bases).
struct LensGate {
  float factor;
  float sigmas;
};
inline constexpr LensGate kLensWrong{1.15F, kSurelySigmas};
inline constexpr LensGate kLensRight{1.10F, kGateSigmas};

}  // namespace fencepost::recon
