// The alert of "something", with object id 0, by the guard's points on the floor that the robot is about to sweep.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/alert/alerts.hpp"
#include "firmware/alert/known_room.hpp"
#include "firmware/alert/swept_area.hpp"
#include "firmware/alert/tuning.hpp"
#include "firmware/recon/guard/guard.hpp"

namespace fencepost::alert {

/// Robot frame.
struct FrontAhead {
  record::AlertLevel due = record::AlertLevel::kClear;   ///< the level by the thresholds
  record::AlertLevel held = record::AlertLevel::kClear;  ///< the same, thresholds widened by the hysteresis
  float speed = kFastest;                                ///< m/s, see stopping_speed()
  bool something = false;                                ///< so near that an object never seen whole may be it
  Obstacle nearest;  ///< the nearest point in the area; not known if there is none near enough to warn
  std::uint8_t signature = 0;
  float confidence = 0;  ///< in [0, 1]: the share of the last frames that saw it, less what looked past it
};

/// `robot`: by odometry alone, as the guard's points.
FrontAhead see_fronts(std::span<const recon::guard::Front> fronts, recon::MapPoint origin, const RobotPlace& robot,
                      const RobotPath& path, const AlertRules& rules);

/// m. What is farther the guard does not know.
inline constexpr float kGuardReach = metres(recon::guard::kFarthest);

/// The guard knows something within `reach` (m) of a place of the robot frame.
bool front_within(std::span<const recon::guard::Front> fronts, recon::MapPoint origin, const RobotPlace& robot,
                  const recon::Vec2& place, float reach);

/// Updates the guard's state and returns the level to report now, if any. `others`: the highest level in force for any
/// object. The level rises only above that one, so that nothing is reported twice. It then holds until the fronts
/// themselves are farther, but is not repeated while an object's alert is as high.
std::optional<record::AlertLevel> judge(AlertState& state, const FrontAhead& front, record::AlertLevel others,
                                        const AlertRules& rules, base::Time now);

}  // namespace fencepost::alert
