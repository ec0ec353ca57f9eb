// Decides whether the robot may drive, for every output that releases motors. These are a board's STOP pin, a Linux
// machine's line and frame, and a wheel base that drives. Where anything is not known, the answer is no.
#pragma once

#include <algorithm>
#include <cstdint>

#include "firmware/console/links.hpp"
#include "firmware/record/records.hpp"
#include "hal/base/stamp.hpp"
#include "hal/base/units.hpp"

namespace fencepost::loop {

/// Three heartbeats: if stream time stops for longer, the loop is not live, whatever it reported last.
inline constexpr base::Duration kLive = base::milliseconds(300);

class MotionPermit {
 public:
  /// `beat`: the heartbeat in force now. `links`: the states of the drivers' cables; for a stationary robot they react
  /// sooner than the stream. `now`: this robot's clock.
  [[nodiscard]] bool judge(const record::Heartbeat& beat, const console::Links& links, base::Time now) {
    if (begun_ && beat.t != t_) await(beat.t, now);
    if (!begun_ || beat.t != t_) passed_ = base::Stamp(now);
    begun_ = true;
    t_ = beat.t;
    if (beat.t + kLive >= awaited_ || awaited_since_.since(now) > kLive) awaited_ = {};
    const bool live = passed_.since(now) <= kLive && awaited_.raw == 0;
    using sensor::works;
    const bool sees = works(beat.camera) && works(beat.odometry) && works(links.camera) && works(links.odometry);
    return live && sees && beat.level < record::AlertLevel::kStop;
  }

 private:
  // After a pause the loop first works off old inputs, so its reports are stale. A sender that paused stays behind for
  // good; its reports count again once it has gone on for a while.
  void await(base::Time t, base::Time now) {
    const base::Duration own = passed_.since(now);
    if (t < t_ || own - (t - t_) <= kLive) return;
    awaited_ = t_ + own;
    awaited_since_ = base::Stamp(now);
  }

  base::Time t_;               ///< of the stream, when it was last judged
  base::Stamp passed_;         ///< when it last passed, by this robot's clock
  base::Time awaited_;         ///< of the stream, which has fallen behind that clock; 0: it has not
  base::Stamp awaited_since_;  ///< by that clock
  bool begun_ = false;
};

/// The maximum speed in mm/s; INT16_MAX, more than any robot drives, if it is not known.
constexpr std::int16_t most_of(const record::SpeedLimit& limit) {
  constexpr std::int32_t kUnits = base::Metres::kPerUnit / 1000;
  if (!limit.speed) return INT16_MAX;
  return static_cast<std::int16_t>(std::min<std::int32_t>(limit.speed->raw / kUnits, INT16_MAX));
}

/// The maximum speed of a base that drives by itself. After a stop it drives on only when nothing warns any more.
/// Otherwise it would creep up to the obstacle in jerks, because an obstacle does not come closer to a stationary
/// robot.
class DrivePermit {
 public:
  /// mm/s; 0: it has to stop.
  [[nodiscard]] std::int16_t judge(bool may_move, record::AlertLevel level, const record::SpeedLimit& limit) {
    going_ = may_move && (going_ || level < record::AlertLevel::kWarn);
    return going_ ? most_of(limit) : std::int16_t{0};
  }

 private:
  bool going_ = false;
};

}  // namespace fencepost::loop
