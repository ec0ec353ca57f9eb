// From the map's floats to the records of the stream: the only place where estimates are rounded to decimals.
#pragma once

#include "firmware/alert/front_alert.hpp"
#include "firmware/console/counters.hpp"
#include "firmware/console/text.hpp"
#include "firmware/recon/localize/landmark_filter.hpp"
#include "firmware/recon/track/object.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::console {

/// An object not seen for this long is lost from sight; its place in the map stays.
inline constexpr base::Duration kLostAfter = base::milliseconds(1000);

record::ObjectState state_of(const recon::ObjectCore& object, base::Time now);

/// Needs an estimate: object.cylinder.estimate().ok().
record::ObjectReport report_object(const recon::ObjectCore& object, const alert::Obstacle& obstacle, base::Time now);

/// The robot's pose at t, with the correction's own sigmas.
record::Position report_pose(const recon::MapPose& pose, const recon::PoseSigma& sigma, base::Time t);

record::StatusReport report_status(base::Time now, const Counters& counters, std::uint32_t objects);

Nearest nearest_of(const alert::Obstacle& obstacle);

record::AlertReport report_alert(const recon::ObjectCore& object, const alert::Obstacle& obstacle,
                                 record::AlertLevel level, base::Time now);
/// The guard's alert, with object id 0. Needs a front.
record::AlertReport report_alert(const alert::FrontAhead& front, record::AlertLevel level, base::Time now);
/// The alert at level blind.
record::AlertReport report_blind(base::Time now);
/// For an object that has ended, or a front that is gone: the bearing and distance of the last report, with confidence
/// 0.
record::AlertReport report_clear(std::uint32_t id, const alert::AlertState& last, base::Time now);

}  // namespace fencepost::console
