// Decides whether the robot can know what is ahead. It uses only the times and contents of the inputs, so a replay
// decides as the robot did. The state of a driver's cable is in FPLNK.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "hal/base/stamp.hpp"
#include "hal/sensor/link_state.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::alert {

/// The usual interval of a kind of input, and whether the next one is overdue.
class Rhythm {
 public:
  void beat(base::Time t);
  [[nodiscard]] bool begun() const { return begun_; }
  /// Once begun.
  [[nodiscard]] base::Duration since_last(base::Time t) const { return last_.since(t); }
  /// `standing`: nothing comes nearer by the robot's own motion, so there is more time. Never, before the first.
  [[nodiscard]] bool overdue(base::Time now, bool standing) const;

 private:
  bool begun_ = false;
  std::uint16_t interval_ = 0;  ///< ms, smoothed
  base::Stamp last_;
};

/// Why the robot cannot know what is ahead; the first that applies.
enum class Blindness : std::uint8_t {
  kNone,
  kNoCamera,    ///< no frame has come yet
  kNoOdometry,  ///< no sample has come yet
  kCameraLate,  ///< frames came and come no more
  kOdometryLate,
  kFramesUnused,  ///< frames come and are refused
  kFrozen,        ///< frames come that do not change although the robot moves
  kJump,          ///< odometry reports a motion that no robot makes
};

/// Everything about one run's inputs that this needs.
class Sight {
 public:
  /// The run begins.
  void start(base::Time t);
  void odometry_came(const sensor::OdometrySample& sample);
  /// A frame was accepted.
  void frame_came(base::Time t);
  /// It was placed in the map. `odometry`: where the robot was when it was exposed.
  void frame_used(const recon::WaitingFrame& frame, const recon::CameraModel& camera, const recon::MapPose& odometry);

  /// `standing`: by the latest odometry. When a run has just begun, nothing is overdue yet.
  [[nodiscard]] Blindness blindness(base::Time now, bool standing) const;
  /// Nothing has been seen yet in this run: whatever may be ahead.
  [[nodiscard]] bool nothing_seen() const { return !used_.begun(); }

  /// For the heartbeat: absent (nothing yet), silent (no more), unready (of no use), empty (nothing to see), ok.
  [[nodiscard]] sensor::LinkState camera_state(base::Time now, bool standing) const;
  [[nodiscard]] sensor::LinkState odometry_state(base::Time now, bool standing) const;

 private:
  enum class Image : std::uint8_t { kChanges, kLate, kFrozen };

  [[nodiscard]] bool jumped_lately(base::Time now) const;
  void image_changed(base::Time t);
  [[nodiscard]] base::Duration image_patience() const;

  bool started_ = false;
  bool jumped_ = false;
  Image image_ = Image::kChanges;
  std::uint8_t slow_image_ = 0;  ///< 2 ms, that the last one took; 0: no longer than kFrozenFor
  Rhythm frames_;
  Rhythm used_;
  Rhythm odometry_;
  base::Stamp started_at_;
  base::Stamp jumped_at_;
  base::Stamp blobs_at_;      ///< the last frame with a blob
  std::uint32_t boxes_ = 0;   ///< hash of the last frame's; 0: it had none
  base::Stamp same_since_;    ///< when they became what they are,
  recon::MapPose same_from_;  ///< and where the robot was then
  recon::MapPose told_;       ///< by the latest sample
};

}  // namespace fencepost::alert
