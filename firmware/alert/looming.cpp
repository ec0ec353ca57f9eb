#include "firmware/alert/looming.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "firmware/recon/observe/occlusion.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::alert {

using recon::FloorCamera;
using recon::kSlopeBits;
using recon::kSlopeOne;
using recon::nearest_whole;

namespace {

constexpr int kDepthBits = 4;                   // of LoomingTrack::depth below the millimetre
constexpr int kSecondBits = 10;                 // of times below the second
constexpr int kGainBits = 10;                   // of the filter's gains below one
constexpr std::int32_t kMaxVariance = 1 << 20;  // products with gains stay inside 32 bits
constexpr std::int32_t kMaxDepth = 4000;        // mm, with which FloorCamera::depth_of_row is right

std::int16_t to_int16(std::int32_t value) {
  return static_cast<std::int16_t>(std::clamp<std::int32_t>(value, INT16_MIN, INT16_MAX));
}
std::uint16_t to_depth(std::int32_t value) {
  return static_cast<std::uint16_t>(std::clamp<std::int32_t>(value, 0, kMaxDepth << kDepthBits));
}
std::int32_t bounded(std::int32_t variance) { return std::clamp(variance, -kMaxVariance, kMaxVariance); }

// 2^-10 s; what is longer than recon::kMoment does not matter.
std::int32_t whole_time(base::Duration span) {
  constexpr std::int64_t kMax = recon::kMoment.raw;
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(span.raw, 0, kMax)) * 6711 >> 16;
}
constexpr std::int32_t in_time(base::Duration span) { return static_cast<std::int32_t>(span.raw * 1024 / 10'000); }

// How the lens has moved since the frame before, in the camera frame of that one.
struct Step {
  std::int32_t time = 0;     // 2^-10 s
  std::int32_t forward = 0;  // 2^-4 mm
  std::int32_t left = 0;
  std::int32_t turn = 0;  // to the left, 2^-14 rad
};

void follow_odometry(const recon::MapPose& from, const recon::MapPose& to, const recon::CameraModel& camera,
                     Step& step) {
  if (from == to) return;
  const auto turn_urad = static_cast<float>(recon::short_way(std::int64_t{to.heading} - from.heading));
  const base::SinCos heading = base::sincos_urad(from.heading);
  const recon::Vec2 moved = recon::rotated({heading.cos, -heading.sin}, recon::offset_from(from.position, to.position));
  const float turn = 1e-6F * turn_urad;
  const recon::Vec2 lens = moved + turn * recon::left_of(camera.position);
  const recon::Vec2 seen = recon::rotated({camera.yaw.x(), -camera.yaw.y()}, lens);
  constexpr float kUnits = 1000.0F * (1 << kDepthBits);
  constexpr std::int32_t kFarthestStep = 1000 << kDepthBits;
  step.forward = nearest_whole(kUnits * seen.x(), kFarthestStep);
  step.left = nearest_whole(kUnits * seen.y(), kFarthestStep);
  step.turn = nearest_whole(static_cast<float>(kSlopeOne) * turn, kSlopeOne / 2);
}

// The robot's own motion of late, in the camera's frame.
struct Robot {
  Robot(std::int32_t forward, std::int32_t left, std::int32_t turning) : speed(std::abs(forward)) {
    const std::int32_t aside = std::abs(left);
    const bool no_turn = std::abs(turning) < kRobotStraight;
    straight = no_turn && 4 * aside < speed + 4 * kRobotWavers;
    stands = no_turn && speed < kRobotWavers && aside < kRobotWavers;
  }
  std::int32_t speed = 0;  // mm/s, along the camera's axis
  bool straight = false;
  bool stands = false;
};

// Predicts the track at constant speed.
void predict(LoomingTrack& track, const Step& step) {
  const std::int32_t dt = step.time;
  constexpr int kBits = kSecondBits - kDepthBits;
  const std::int32_t nearer = step.forward + (track.speed * dt >> kBits);
  const std::int32_t aside = (track.across * dt >> kBits) - step.left;
  std::int32_t depth = track.depth;
  std::int32_t slope = track.slope;
  if (step.turn != 0) {
    depth += depth * (slope * step.turn >> kSlopeBits) >> kSlopeBits;
    slope -= step.turn + ((slope * slope >> kSlopeBits) * step.turn >> kSlopeBits);
  }
  depth -= nearer;
  slope += (slope * nearer + aside * kSlopeOne) / std::max(depth, kMinDepth << kDepthBits);
  track.depth = to_depth(depth);
  track.slope = to_int16(slope);
  const std::int32_t lost = track.speed_variance * dt >> kSecondBits;
  track.depth_variance = bounded(track.depth_variance + ((lost - 2 * track.covariance) * dt >> kSecondBits));
  track.covariance = bounded(track.covariance - lost);
  track.speed_variance = bounded(track.speed_variance + (kUnsteady * dt >> kSecondBits));
  track.unseen = static_cast<std::uint16_t>(std::min<std::int32_t>(track.unseen + dt, 0xFFFF));
  track.unmeasured =
      static_cast<std::uint8_t>(std::min<std::int32_t>(track.unmeasured + std::max<std::int32_t>(dt >> 4, 1), 0xFF));
}

// A box as the filters take it. Small: sixteen of them are on the stack.
struct Seen {
  std::int32_t left = 0;  // slopes of the ends
  std::int32_t right = 0;
  std::int16_t depth = 0;  // mm, of the foot; 0: it is not seen
  std::int16_t sigma = 0;  // mm, of that depth
  std::int16_t columns = 0;
  std::uint8_t signature = 0;
  bool left_cut : 1 = false;
  bool right_cut : 1 = false;
  bool low : 1 = false;     // its foot is below the image
  bool hidden : 1 = false;  // or behind something nearer

  [[nodiscard]] bool whole() const { return !left_cut && !right_cut; }
  [[nodiscard]] std::int32_t middle() const { return (left + right) / 2; }
  [[nodiscard]] std::int32_t across() const { return std::max(left - right, std::int32_t{1}); }
  // mm, of something that deep
  [[nodiscard]] std::int32_t width_at(std::int32_t mm) const { return mm * across() >> kSlopeBits; }
  // mm, of something that wide
  [[nodiscard]] std::int32_t depth_of(std::int32_t width) const {
    return std::min((width << kSlopeBits) / across(), kMaxDepth);
  }
};

// Slopes of a camera of which only the focal length is known.
std::int32_t slope_of(const recon::CameraModel& camera, float u) {
  return nearest_whole(static_cast<float>(kSlopeOne) * (camera.cx - u) / camera.fx, 2 * kSlopeOne);
}

Seen see(const FloorCamera& floor, const recon::CameraModel& camera, const recon::WaitingFrame& frame,
         std::size_t index) {
  const recon::WaitingBlob& blob = frame.blobs[index];
  const recon::Box& box = blob.box;
  const recon::Sides cut = recon::cut_by_border(camera, box);
  const recon::Sides hidden = recon::hidden_sides(frame.blobs.view(), index, camera.rows);
  Seen seen;
  seen.signature = blob.signature;
  seen.columns = static_cast<std::int16_t>(box.x2 - box.x1 + 1);
  seen.left_cut = cut.left || hidden.left;
  seen.right_cut = cut.right || hidden.right;
  seen.low = cut.bottom;
  seen.hidden = hidden.bottom;
  if (!floor.usable()) {
    seen.left = slope_of(camera, recon::left_edge(box));
    seen.right = slope_of(camera, recon::right_edge(box));
    return seen;
  }
  const auto [left, right] = floor.at(2 * box.x1 - 1, 2 * box.x2 + 1, 2 * box.y2 + 1);
  seen.left = left.slope;
  seen.right = right.slope;
  const std::int32_t depth = std::min(left.depth, right.depth);
  if (seen.low || seen.hidden || depth > kMaxDepth) return seen;
  seen.depth = to_int16(std::max(depth, kMinDepth));
  seen.sigma = to_int16((kRowSigma * floor.depth_of_row(seen.depth) >> 2) + kDepthSigma);
  return seen;
}

constexpr std::int32_t kNotIt = INT32_MAX;  // outside the gate
// Cost of matching a box to a track; 0 is the best.
std::int32_t unlikeness(const LoomingTrack& track, const Seen& seen) {
  if (seen.signature != track.signature) return kNotIt;
  const std::int32_t depth = std::max<std::int32_t>(track.depth >> kDepthBits, kMinDepth);
  const std::int32_t half = seen.across() / 2;
  const std::int32_t aside = std::abs(seen.middle() - track.slope);
  // A track with one sighting may move in any direction.
  const std::int32_t may =
      track.sightings > 1 ? 0 : (kFastestThing * track.unseen << (kSlopeBits - kSecondBits)) / depth;
  if (aside > half + kSideGate + may) return kNotIt;
  if (seen.depth == 0) return aside;
  const std::int32_t off = std::abs(std::int32_t{seen.depth} - depth);
  if (4 * off > 3 * std::max<std::int32_t>(seen.depth, depth)) return kNotIt;
  return aside + (off << kSlopeBits) / (4 * depth);
}

enum class Belief : std::uint8_t { kTaken, kStray };

// The Kalman filter's update with a depth and its sigma. The innovation is computed in inverse depth, as rows and
// columns measure it, for there errors are symmetric.
Belief take_depth(LoomingTrack& track, std::int32_t depth, std::int32_t sigma) {
  const std::int32_t expected = std::max<std::int32_t>(track.depth >> kDepthBits, kMinDepth);
  const std::int32_t off = std::clamp((depth - expected) * expected / depth, -kMaxDepth, kMaxDepth);
  const std::int32_t variance = track.depth_variance + std::min(sigma * sigma, kMaxVariance);
  if (off * off / kDepthGate > variance) return Belief::kStray;
  const std::int32_t gain = (track.depth_variance << kGainBits) / variance;
  const std::int32_t speed_gain = (track.covariance << kGainBits) / variance;
  const auto less_speed =
      static_cast<std::int32_t>(static_cast<std::int64_t>(speed_gain) * track.covariance >> kGainBits);
  track.depth = to_depth(track.depth + (gain * off >> (kGainBits - kDepthBits)));
  track.speed = to_int16(track.speed + (speed_gain * off >> kGainBits));
  track.speed_variance = std::max(std::int32_t{1}, track.speed_variance - less_speed);
  track.covariance -= gain * track.covariance >> kGainBits;
  track.depth_variance = std::max(std::int32_t{1}, track.depth_variance - (gain * track.depth_variance >> kGainBits));
  return Belief::kTaken;
}

// Least squares over the last sightings: as many as kDirectionSpan holds.
void take_direction(LoomingTrack& track, std::int32_t slope, std::int32_t time) {
  const std::int32_t n = track.sightings + 1;
  const std::int32_t off = std::clamp(slope - track.slope, -kSlopeOne / 2, kSlopeOne / 2);
  const std::int32_t weights = n * (n + 1);
  track.slope = to_int16(track.slope + off * 2 * (2 * n - 1) / weights);
  const std::int32_t aside = off * (track.depth >> kDepthBits) >> kSlopeBits;  // mm
  track.across = to_int16(track.across + aside * (6 << kSecondBits) / (weights * time));
  const bool more = n <= kMinSightings || (n < kMaxSightings && n * time < in_time(kDirectionSpan));
  if (more) track.sightings = static_cast<std::uint8_t>(n);
}

// Computes the slope of the middle; a box cut on one side has it half the track's width beside the other end. False if
// that is not known.
bool find_middle(const LoomingTrack& track, const Seen& seen, std::int32_t& middle) {
  middle = seen.middle();
  if (seen.whole()) return true;
  if ((seen.left_cut && seen.right_cut) || track.width == 0) return false;
  const std::int32_t depth = std::max<std::int32_t>(track.depth >> kDepthBits, kMinDepth);
  const std::int32_t half = (track.width << (kSlopeBits - 1)) / depth;
  middle = seen.left_cut ? seen.right + half : seen.left - half;
  return true;
}

// Counts frames of sure approach; a track that already comes has a lower threshold.
void count_sure(LoomingTrack& track, std::int32_t robot_speed) {
  const std::int32_t sigmas = track.comes() ? kStillSigmas : kSureSigmas;
  const std::int32_t least = (kMinOwn + (kOwnShare * robot_speed >> 4)) * sigmas / kSureSigmas;
  const bool scaled = !track.guessed || robot_speed < kRobotWavers;
  const bool surely = track.speed * track.speed / (sigmas * sigmas) > track.speed_variance;
  if (!(scaled && surely && track.speed > least)) {
    track.sure = 0;
  } else if (track.sure < 0xFF) {
    ++track.sure;
  }
}

// Lateral motion is trusted only while the robot is stationary. Axial motion is trusted only while the robot drives
// straight and the track is ahead and seen whole. A thing that is passed leaves the image piece by piece.
void count_moved(LoomingTrack& track, const Robot& robot) {
  const std::int32_t depth = track.depth >> kDepthBits;
  const std::int32_t along = std::abs(std::int32_t{track.speed});
  const std::int32_t across = std::abs(std::int32_t{track.across});
  const std::int32_t share = track.speed > 0 ? kNearingShare : kMovedShare;
  const bool ahead = track.whole >= kWholeSightings && std::abs(std::int32_t{track.slope}) < kAheadSlope;
  const bool surely_along = ahead && robot.straight && along > std::max(kMinMoved, share * robot.speed >> 4) &&
                            4 * along * along / (kMovedSigmas * kMovedSigmas) > track.speed_variance;
  const bool surely_across =
      robot.stands && track.sightings >= kMinSightings && across > kMinMoved + (depth >> kMovedDepthShareLog2);
  if (!track.guessed && (surely_along || surely_across)) {
    // A crossing track soon leaves the image, so it counts three times.
    track.moved = static_cast<std::uint8_t>(std::min(track.moved + (surely_across ? 3 : 1), 3 * kMovedFrames));
  } else if (track.moved > 0) {
    --track.moved;
  }
}

void begin(LoomingTrack& track, const FloorCamera& floor, const Seen& seen) {
  track = {};
  std::int32_t depth = seen.depth;
  std::int32_t sigma = seen.sigma;
  if (depth == 0) {
    // Below the image it is somewhere nearer than where feet leave that; else anywhere.
    depth = floor.usable() ? floor.nearest_visible() * recon::guard::kUnseenFoot >> 4 : seen.depth_of(kGuessedWidth);
    depth = std::clamp(depth, kMinDepth, kMaxDepth);
    sigma = depth / 4;
    track.guessed = true;
  }
  if (seen.whole()) track.width = static_cast<std::uint16_t>(seen.width_at(depth));
  track.depth = to_depth(depth << kDepthBits);
  track.depth_variance = std::min(sigma * sigma, kMaxVariance);
  track.speed_variance = kFirstSpeedVariance;
  track.slope = to_int16(seen.middle());
  track.low = seen.low;
  track.signature = seen.signature;
  track.sightings = 1;
}

void take(LoomingTrack& track, const FloorCamera& floor, const Seen& seen, const Robot& robot) {
  const std::int32_t since = std::max(std::int32_t{track.unseen}, std::int32_t{1});
  track.unseen = 0;
  track.low = seen.low;
  // At the border a box that has lost a piece seems whole, and farther away.
  track.whole = static_cast<std::uint8_t>(seen.whole() ? std::min(track.whole + 1, 3) : 0) & 3U;
  Belief belief = Belief::kTaken;
  bool measured = true;
  if (seen.depth > 0) {
    if (track.guessed) return begin(track, floor, seen);
    belief = take_depth(track, seen.depth, seen.sigma);
  } else if (!seen.hidden && track.whole >= kWholeSightings && track.width > 0) {
    // Its width says how far it is.
    const std::int32_t expected = std::max<std::int32_t>(track.depth >> kDepthBits, kMinDepth);
    const std::int32_t sigma = kColumnSigma * expected / (4 * seen.columns) + kDepthSigma;
    belief = take_depth(track, std::max(seen.depth_of(track.width), kMinDepth), sigma);
  } else {
    measured = false;
  }
  if (belief == Belief::kStray) {
    ++track.strays;
    if (track.strays >= recon::kFewestViews) begin(track, floor, seen);
    return;
  }
  track.strays = 0;
  if (seen.depth > 0 && seen.whole()) {
    const std::int32_t width = seen.width_at(std::max<std::int32_t>(track.depth >> kDepthBits, kMinDepth));
    const std::int32_t share = std::min(std::int32_t{track.sightings} + 1, kAveragedFrames);
    track.width = static_cast<std::uint16_t>(track.width == 0 ? width : track.width + (width - track.width) / share);
  }
  std::int32_t middle = 0;
  if (find_middle(track, seen, middle)) take_direction(track, middle, since);
  if (seen.depth > 0) count_moved(track, robot);
  if (!measured) return;
  track.unmeasured = 0;
  count_sure(track, robot.speed);
}

// True if the box is near enough that its growth can matter, and no part of something nearer.
bool worth_following(const FloorCamera& floor, const Seen& seen) {
  if (seen.depth > 0) return seen.depth <= kFarthestFollowed;
  if (seen.hidden || !seen.whole()) return false;
  return seen.low || (!floor.usable() && seen.columns >= recon::kClearPixels);
}

// A free slot, else that of the farthest track that does not approach, if it is unseen or farther than `depth` (mm).
LoomingTrack* slot_for(std::span<LoomingTrack> tracks, std::int32_t depth) {
  LoomingTrack* farthest = nullptr;
  for (LoomingTrack& track : tracks) {
    if (!track.used()) return &track;
    if (track.comes()) continue;
    if (farthest == nullptr || track.depth > farthest->depth) farthest = &track;
  }
  const bool farther = farthest != nullptr && (farthest->unseen > 0 || farthest->depth >> kDepthBits > depth);
  return farther ? farthest : nullptr;
}

bool is_over(const LoomingTrack& track) {
  const bool beside = track.slope == INT16_MIN || track.slope == INT16_MAX;
  if (beside || track.unmeasured > in_time(kUnmeasured) >> 4) return true;
  // A track that approaches below the image is kept longer.
  const bool below = track.low && track.comes();
  return track.unseen > in_time(below ? kComesUnseen : kUnseen);
}

// The place of a thing and its velocity relative to the robot, robot frame.
struct Meeting {
  recon::Vec2 place{0, 0};     // m
  recon::Vec2 velocity{0, 0};  // m/s
};

Meeting meeting_of(const LoomingTrack& track, const recon::CameraModel& camera, const RobotPath& path, float since,
                   bool own_motion_known) {
  constexpr float kPerSlope = 1.0F / kSlopeOne;
  constexpr float kMetres = 0.001F;
  const float slope = kPerSlope * track.slope;
  const float depth = kMetres / (1 << kDepthBits) * track.depth;
  const float speed = kMetres * track.speed;
  const recon::Vec2 own{-speed, kMetres * track.across};
  Meeting meeting;
  meeting.place = camera.position + recon::rotated(camera.yaw, {depth, slope * depth});
  meeting.velocity = recon::rotated(camera.yaw, own);
  if (own_motion_known) meeting.velocity.x() -= path.motion.forward;
  meeting.place += since * meeting.velocity;
  return meeting;
}

record::AlertLevel level_of(float ttc, const AlertRules& rules, float slack) {
  if (ttc <= slack * rules.ttc_stop) return record::AlertLevel::kStop;
  return ttc <= slack * rules.ttc_warn ? record::AlertLevel::kWarn : record::AlertLevel::kClear;
}

// As early as what is not known well calls for.
float early_by(const LoomingTrack& track, float ttc, float closing, const AlertRules& rules) {
  const float depth_sigma = 0.001F * std::sqrt(static_cast<float>(track.depth_variance));
  const float speed_sigma = 0.001F * std::sqrt(static_cast<float>(track.speed_variance));
  const float sigma = (depth_sigma + ttc * speed_sigma) / closing;
  return kLookSeconds + std::min(recon::kUsualSigmas * sigma, kMaxEarly * rules.ttc_stop);
}

// m/s, see stopping_speed(): of the way to the thing, what it does not come itself meanwhile.
float speed_before(const Meeting& meeting, float closing, float ttc_stop, const RobotPath& path) {
  if (!(meeting.place.x() > 0) || path.motion.forward < -kStanding) return kFastest;
  const float distance = meeting.place.norm();
  const float share = meeting.place.x() / distance;
  const float own = closing - share * path.motion.forward;
  const float free = (distance - path.body_radius - own * (ttc_stop + kSlowsWithin)) / share;
  return stopping_speed(free, ttc_stop, free);
}

FrontAhead judge_track(const LoomingTrack& track, const Meeting& meeting, const RobotPath& path,
                       const AlertRules& rules) {
  FrontAhead front;
  const float distance = meeting.place.norm();
  const float speed = meeting.velocity.norm();
  if (!(distance > 0) || !(speed > kNotClosing)) return front;
  const float closing = -meeting.place.dot(meeting.velocity) / distance;
  if (!(closing > kNotClosing)) return front;
  const float miss = std::fabs(recon::cross(meeting.place, meeting.velocity)) / speed - 0.0005F * track.width;
  if (miss > kHysteresis * path.half_width) return front;
  const float ttc = std::max(0.0F, distance - path.body_radius) / closing;
  const float early = early_by(track, ttc, closing, rules);
  front.held = level_of(ttc - early, rules, kHysteresis);
  if (miss <= path.half_width) {
    front.due = level_of(ttc - early, rules, 1.0F);
    front.speed = speed_before(meeting, closing, rules.ttc_stop + early, path);
  }
  if (front.held == record::AlertLevel::kClear) return front;
  Obstacle& obstacle = front.nearest;
  obstacle.known = true;
  obstacle.toward = meeting.place;
  obstacle.distance = distance;
  obstacle.closing = true;
  obstacle.closing_speed = closing;
  obstacle.ttc = ttc;
  obstacle.in_path.emplace();
  front.signature = track.signature;
  const float own = static_cast<float>(std::max(std::int16_t{1}, track.speed));
  front.confidence = 1 - std::min(1.0F, std::sqrt(static_cast<float>(track.speed_variance)) / own);
  return front;
}

}  // namespace

void LoomingCore::look(std::span<LoomingTrack> tracks, recon::WaitingFrame& frame, const recon::CameraModel& camera,
                       const recon::MapPose* odometry) {
  const base::Time t = frame.t - camera.latency;
  const base::Duration since = has_looked_ ? looked_at_.since(t) : base::Duration{0};
  if (since > recon::kMoment) std::fill(tracks.begin(), tracks.end(), LoomingTrack{});
  Step step;
  step.time = std::max(std::int32_t{1}, whole_time(since));
  if (odometry != nullptr && has_odometry_) follow_odometry(odometry_, *odometry, camera, step);
  const bool other_scale = (odometry != nullptr) != has_odometry_;
  const auto smooth = [&](std::int16_t& rate, std::int32_t moved, int bits) {
    rate = to_int16(rate + ((moved << bits) / step.time - rate) / kAveragedFrames);
  };
  smooth(robot_speed_, step.forward, kSecondBits - kDepthBits);
  smooth(robot_aside_, step.left, kSecondBits - kDepthBits);
  smooth(robot_turn_, step.turn, kSecondBits);
  if (odometry == nullptr) robot_speed_ = 0;
  const Robot robot(robot_speed_, robot_aside_, robot_turn_);
  has_looked_ = true;
  looked_at_ = base::Stamp(t);
  has_odometry_ = odometry != nullptr;
  if (has_odometry_) odometry_ = *odometry;
  for (LoomingTrack& track : tracks) {
    if (!track.used()) continue;
    if (other_scale) {
      track.speed_variance = bounded(track.speed_variance + kFirstSpeedVariance / 4);
      track.moved = 0;  // without odometry, the robot's motion counted as the track's
    }
    predict(track, step);
    if (is_over(track)) track = {};
  }
  if (frame.blobs.empty()) return;

  const FloorCamera& floor = camera.floor;
  base::FixedVector<Seen, sensor::kMaxBlobs> boxes;
  for (std::size_t b = 0; b < frame.blobs.size(); ++b) static_cast<void>(boxes.push_back(see(floor, camera, frame, b)));
  // Each box goes to the thing that it is most like, if no other box is more like that.
  std::array<bool, sensor::kMaxBlobs> taken{};
  for (std::size_t b = 0; b < boxes.size(); ++b) taken[b] = frame.blobs[b].bearing;  // it has no width that grows
  for (;;) {
    LoomingTrack* best = nullptr;
    std::size_t box = 0;
    std::int32_t least = kNotIt;
    for (LoomingTrack& track : tracks) {
      if (!track.used() || track.unseen == 0) continue;
      for (std::size_t b = 0; b < boxes.size(); ++b) {
        if (taken[b]) continue;
        const std::int32_t cost = unlikeness(track, boxes[b]);
        if (cost >= least) continue;
        least = cost;
        best = &track;
        box = b;
      }
    }
    if (best == nullptr) break;
    taken[box] = true;
    take(*best, floor, boxes[box], robot);
    frame.blobs[box].moves = has_odometry_ && best->moves();
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    if (taken[b] || !worth_following(floor, boxes[b])) continue;
    LoomingTrack* const slot = slot_for(tracks, boxes[b].depth);
    if (slot != nullptr) begin(*slot, floor, boxes[b]);
  }
}

FrontAhead LoomingCore::ahead(std::span<const LoomingTrack> tracks, const recon::CameraModel& camera,
                              const RobotPath& path, const AlertRules& rules, base::Time now) const {
  FrontAhead front;
  const auto since = static_cast<float>(looked_at_.since(now).raw) / static_cast<float>(base::Duration::kPerUnit);
  for (const LoomingTrack& track : tracks) {
    if (!track.used() || !track.comes()) continue;
    const Meeting meeting = meeting_of(track, camera, path, since, has_odometry_);
    front = more_urgent(front, judge_track(track, meeting, path, rules));
  }
  return front;
}

FrontAhead more_urgent(const FrontAhead& one, const FrontAhead& other) {
  const bool nearer = !one.nearest.known || (other.nearest.known && other.nearest.distance < one.nearest.distance);
  FrontAhead front = other.due > one.due || (other.due == one.due && nearer) ? other : one;
  if (!front.nearest.known && one.nearest.known) front = one;
  front.due = std::max(one.due, other.due);
  front.held = std::max(one.held, other.held);
  front.speed = std::min(one.speed, other.speed);
  front.something = one.something || other.something;
  return front;
}

}  // namespace fencepost::alert
