// Numbers of the alerts that were chosen and not derived. "Alert study": tests/studies/alerts, on the seeds that its
// README names for tuning. "By design": no study was made for the value. What a user may set is in
// firmware/config/settings.hpp.
#pragma once

#include "hal/base/units.hpp"

namespace fencepost::alert {

/// The path is watched at least so often, with frames or without. More: late stops; less: instructions. By design.
inline constexpr base::Duration kWatchInterval = base::milliseconds(100);
/// A level eases only when the obstacle is farther than its threshold by this factor, for this long. More: stale
/// alerts; less: alerts that flicker. By design.
inline constexpr float kHysteresis = 1.15F;
inline constexpr base::Duration kEaseAfter = base::milliseconds(300);
/// A notice is repeated no more often than this: it says where things are, nothing is urgent. By design.
inline constexpr base::Duration kNoticeInterval = base::milliseconds(1000);

/// Safety margin for the uncertainty of a distance: it is subtracted before the comparison with the stop distance.
struct Margin {
  float sigmas;
  float most;  ///< as a share of the stop distance: uncertainty must not stop a robot far from anything
};
/// Seen whole; and where an end was not seen, the object may extend much nearer than its cylinder. More: false stops;
/// less: late ones. Alert study.
inline constexpr Margin kSeenWhole{3.0F, 0.2F};
inline constexpr Margin kCutOff{4.0F, 0.4F};

/// m/s. A slower robot stands; what comes nearer more slowly does not come nearer. By design.
inline constexpr float kStanding = 0.01F;
inline constexpr float kNotClosing = 0.005F;
/// m, radii between which a path is an arc: tighter, the robot turns on the spot; flatter, it drives straight. By
/// design.
inline constexpr float kTightestArc = 0.15F;
inline constexpr float kFlattestArc = 50.0F;

}  // namespace fencepost::alert
