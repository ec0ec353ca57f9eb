// Where the robot was when the shutter opened: a fixed ring of odometry, interpolated at the exposure.
#pragma once

#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/fixed.hpp"
#include "hal/base/result.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/odometry.hpp"

namespace fencepost::recon {

/// map_T_robot. Position in 10 um, heading in microradians: interpolation stays in integers, the same everywhere.
struct MapPose {
  MapPoint position;
  std::int32_t heading = 0;
  friend constexpr bool operator==(const MapPose&, const MapPose&) = default;
};

/// Why there is no pose for a time.
enum class PoseMiss : std::uint8_t {
  kNotYet,  ///< odometry has not come that far
  kTooOld,  ///< before the first sample, or before the oldest one that the ring still holds
  kGap,     ///< between two samples more than kMoment apart
};

/// One remembered sample, 20 bytes. The low word of the time is enough: differences inside the ring are short.
struct PoseSample {
  std::uint32_t ticks = 0;
  MapPose pose;
  bool gap_before = false;  ///< the sample before it is too long ago to interpolate
};

MapPose to_map_pose(const sensor::OdometrySample& sample);

/// A difference of two headings (urad) brought into [-pi, pi].
std::int64_t short_way(std::int64_t microradians);

/// Pose between two samples; heading the short way round. `at` lies within [before.ticks, after.ticks].
MapPose interpolate(const PoseSample& before, const PoseSample& after, std::uint32_t at);

/// Robot speed from two poses: metres per second forward, radians per second.
struct Motion {
  float forward = 0;
  float turn = 0;
};
Motion motion_between(const PoseSample& before, const PoseSample& after);

/// N samples; the oldest goes.
template <std::size_t N>
class PoseHistory {
 public:
  void clear() {
    samples_.clear();
    seen_any_ = false;
  }

  /// Samples come in order of time (the stream guarantees it).
  void push(const sensor::OdometrySample& sample) {
    PoseSample entry;
    entry.ticks = low_word(sample.t);
    entry.pose = to_map_pose(sample);
    entry.gap_before = seen_any_ && sample.t - latest_ > kMoment;
    samples_.push_over_oldest(entry);
    latest_ = sample.t;
    seen_any_ = true;
  }

  /// The pose at time t, or why not.
  [[nodiscard]] base::Result<MapPose, PoseMiss> at(base::Time t) const {
    if (samples_.empty() || t > latest_) return PoseMiss::kNotYet;
    if (latest_ - t >= kReach) return PoseMiss::kTooOld;
    const std::uint32_t ticks = low_word(t);
    std::size_t after = samples_.size() - 1;
    while (after > 0 && since(ticks, samples_[after - 1].ticks) < 0) --after;
    // Now `after` is the last sample whose predecessor is not later than t.
    if (since(ticks, samples_[after].ticks) == 0) return samples_[after].pose;
    if (after == 0) return PoseMiss::kTooOld;
    if (since(ticks, samples_[after - 1].ticks) == 0) return samples_[after - 1].pose;
    if (samples_[after].gap_before) return PoseMiss::kGap;
    return interpolate(samples_[after - 1], samples_[after], ticks);
  }

  /// Motion over the newest samples spanning at least `span` (or all there are); zero when unknown.
  [[nodiscard]] Motion motion(base::Duration span) const {
    if (samples_.size() < 2) return {};
    const PoseSample& last = samples_.back();
    std::size_t first = samples_.size() - 1;
    while (first > 0 && !samples_[first].gap_before && since(last.ticks, samples_[first].ticks) < span.raw) --first;
    return motion_between(samples_[first], last);
  }

  [[nodiscard]] bool empty() const { return samples_.empty(); }
  [[nodiscard]] const MapPose& latest() const { return samples_.back().pose; }
  [[nodiscard]] base::Time latest_time() const { return latest_; }

 private:
  // Older than this is out of reach of the 32-bit tick arithmetic: 2^30 ticks, 29 hours.
  static constexpr base::Duration kReach{1LL << 30};

  static std::uint32_t low_word(base::Time t) { return static_cast<std::uint32_t>(t.raw & 0xFFFFFFFFLL); }
  static std::int32_t since(std::uint32_t later, std::uint32_t earlier) {
    return static_cast<std::int32_t>(later - earlier);
  }

  base::Ring<PoseSample, N> samples_;
  base::Time latest_;
  bool seen_any_ = false;
};

}  // namespace fencepost::recon
