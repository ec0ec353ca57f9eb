// The guard beside the map: where the feet of blobs were seen, as points on the floor. It has no objects, identities or
// models. It therefore keeps a wall without visible ends as well as a post, and what the map has just lost. A later
// frame that looks past a point refutes it. Points below or beside the image stay as they were. The map only tells it
// how wide the foot of a known thing can be.
//
// In: frames as the camera sent them, and the robot's pose by odometry alone, for a corrected one may jump. Needs the
// camera's pitch and height. It takes every row for a foot on the floor: things that hang above the floor are nearer
// than it says. For a foot occluded by something nearer it knows the upper bound.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/guard/front.hpp"
#include "firmware/recon/guard/tuning.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "hal/base/fnv1a.hpp"
#include "hal/base/stamp.hpp"

namespace fencepost::recon::guard {

/// Where the foot of a thing of the map can be: the lens's frame, mm.
struct KnownFoot {
  std::int16_t nearest = 0;   ///< least depth
  std::int16_t farthest = 0;  ///< greatest depth
  std::int16_t left = 0;      ///< its ends to the side
  std::int16_t right = 0;
  std::uint8_t signature = 0;
};
/// Of at most eight things, by design: they are on the stack. Of further ones the guard knows nothing.
using KnownFeet = base::FixedVector<KnownFoot, 8>;

/// The same for all capacities.
class GuardCore {
 public:
  [[nodiscard]] MapPoint origin() const { return origin_; }

 protected:
  /// The fronts of this frame, and what it says of those known before. Returns the number of points then.
  [[gnu::noinline]] std::size_t look(std::span<Front> store, const WaitingFrame& frame, const CameraModel& camera,
                                     const LensPose& pose, base::Time stands_since, const KnownFeet& known);
  void hash_part(base::Fnv1a64& hash, std::span<const Front> fronts, std::uint32_t turn) const;

  std::uint8_t size_ = 0;

 private:
  void follow(std::span<Front> fronts, const MapPoint& robot);
  void pass_time(std::span<Front> fronts, base::Time t);

  MapPoint origin_;
  base::Stamp looked_at_;
  bool has_looked_ = false;
  std::uint8_t turn_ = 0;     ///< frames, modulo 256
  std::uint8_t now_ = 0;      ///< kSeenTicks modulo 256
  std::uint8_t elapsed_ = 0;  ///< since the last frame, in kDoubtTicks, at most a third of what refutes
};

template <std::size_t kCapacity>
class Guard : public GuardCore {
 public:
  static_assert(kCapacity < 0xFF);

  /// Nothing was seen yet: a new run, or another calibration.
  void clear() { static_cast<GuardCore&>(*this) = {}; }

  /// `pose`: of the lens at the exposure, by odometry. `stands_since`: see Standing.
  void look(const WaitingFrame& frame, const CameraModel& camera, const LensPose& pose, base::Time stands_since,
            const KnownFeet& known = {}) {
    size_ = static_cast<std::uint8_t>(GuardCore::look(fronts_, frame, camera, pose, stands_since, known));
  }

  [[nodiscard]] std::span<const Front> fronts() const { return {fronts_.data(), size_}; }

  /// One part in turn: `turn` counts frames.
  void hash(base::Fnv1a64& hash, std::uint32_t turn) const { hash_part(hash, fronts(), turn); }

 private:
  std::array<Front, kCapacity> fronts_{};
};

static_assert(sizeof(Guard<64>) <= 560, "with the state of its alert 600 bytes in all");

}  // namespace fencepost::recon::guard
