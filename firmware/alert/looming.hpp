// Tracks of things that approach by their own motion. The fall of a box's foot and the growth of its width give depth
// and own speed. It uses no objects and no models, for those of the map are static.
//
// Two small integer filters follow each thing from frame to frame. A Kalman filter estimates depth and own speed
// towards the lens; there a row is worth the more metres the farther the foot is. Least squares over the last sightings
// estimate direction and its change. Odometry removes the robot's own motion. While it is silent, everything that comes
// nearer counts as moving by itself: the time to contact is right, but who moves is unknown.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/alert/front_alert.hpp"
#include "firmware/alert/tuning.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "hal/base/stamp.hpp"

namespace fencepost::alert {

/// One thing that is followed. Level camera frame of the latest frame, x along the axis, y to the left.
struct LoomingTrack {
  std::int32_t depth_variance = 0;  ///< mm^2
  std::int32_t covariance = 0;      ///< of depth and speed, mm^2/s
  std::int32_t speed_variance = 0;  ///< mm^2/s^2
  std::uint16_t depth = 0;          ///< of the foot, 2^-4 mm; 0: at the lens or behind it
  std::int16_t speed = 0;           ///< its own, towards the lens along the axis, mm/s
  std::int16_t slope = 0;           ///< of its middle, 2^-14
  std::int16_t across = 0;          ///< its own speed to the left, mm/s
  std::uint16_t width = 0;          ///< mm; 0: not known yet
  std::uint16_t unseen = 0;         ///< 2^-10 s since the last sighting
  std::uint8_t signature = 0;
  std::uint8_t sightings = 0;  ///< that the direction is known by; 0: a free slot
  std::uint8_t sure = 0;       ///< frames in a row in which it came closer by itself
  std::uint8_t moved = 0;      ///< frames in which it moved by itself, in any direction, less those in which it did not
  std::uint8_t unmeasured = 0;  ///< 2^-6 s since foot or width last gave its distance
  bool low : 1 = false;         ///< its foot was below the image when it was seen last
  bool guessed : 1 = false;     ///< its width was never seen together with its foot: depth and speed have a scale alone
  std::uint8_t whole : 2 = 0;   ///< sightings in a row with both ends in the image, at most 3
  std::uint8_t strays : 2 = 0;  ///< sightings in a row that are outliers of the filter

  [[nodiscard]] bool used() const { return sightings != 0; }
  [[nodiscard]] bool comes() const { return sure >= kSureFrames; }
  [[nodiscard]] bool moves() const { return moved >= kMovedFrames; }
};
static_assert(sizeof(LoomingTrack) <= 32, "eight of them, or four on the smallest part");

/// The same for all capacities.
class LoomingCore {
 protected:
  /// `odometry`: the robot's pose at the exposure; null while that is not known. Marks the blobs of movers.
  [[gnu::noinline]] void look(std::span<LoomingTrack> tracks, recon::WaitingFrame& frame,
                              const recon::CameraModel& camera, const recon::MapPose* odometry);
  [[nodiscard]] FrontAhead ahead(std::span<const LoomingTrack> tracks, const recon::CameraModel& camera,
                                 const RobotPath& path, const AlertRules& rules, base::Time now) const;

 private:
  base::Stamp looked_at_;         ///< exposure of the latest frame
  recon::MapPose odometry_;       ///< and where the robot was then
  std::int16_t robot_speed_ = 0;  ///< mm/s, smoothed, without its sign
  std::int16_t robot_aside_ = 0;  ///< mm/s to the left, likewise
  std::int16_t robot_turn_ = 0;   ///< 2^-14 rad/s, likewise
  bool has_looked_ = false;
  bool has_odometry_ = false;
};

template <std::size_t kTracks>
class Looming : public LoomingCore {
 public:
  /// Nothing was seen yet: a new run, or another calibration.
  void clear() { *this = {}; }

  /// Updates with one frame, as the camera sent it. `odometry`: null while it is silent. Marks the blobs of movers.
  void look(recon::WaitingFrame& frame, const recon::CameraModel& camera, const recon::MapPose* odometry) {
    LoomingCore::look(tracks_, frame, camera, odometry);
  }

  /// The alert for the things that approach by themselves and will meet the robot on `path`.
  [[nodiscard]] FrontAhead ahead(const recon::CameraModel& camera, const RobotPath& path, const AlertRules& rules,
                                 base::Time now) const {
    return LoomingCore::ahead(tracks_, camera, path, rules, now);
  }

  [[nodiscard]] std::span<const LoomingTrack> tracks() const { return tracks_; }

 private:
  std::array<LoomingTrack, kTracks> tracks_{};
};

/// The thing ahead with the higher level; with equal levels the one that is met first.
FrontAhead more_urgent(const FrontAhead& one, const FrontAhead& other);

}  // namespace fencepost::alert
