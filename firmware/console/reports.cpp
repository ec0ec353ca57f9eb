#include "firmware/console/reports.hpp"

#include <algorithm>

namespace fencepost::console {
namespace {

// A longer time to contact is not reported: the field stays empty (s).
constexpr float kLongestTtc = 999.0F;
// Places outside the stream's range are written at its edge (m).
constexpr float kFarthest = 999.0F;

// Nearest count of 10^-4 units, half away from zero.
std::int32_t ten_thousandths(float value) {
  const float scaled = std::clamp(value, -kFarthest, kFarthest) * 1e4F;
  return static_cast<std::int32_t>(scaled < 0 ? scaled - 0.5F : scaled + 0.5F);
}
base::Metres metres(float value) { return {ten_thousandths(value)}; }
base::Radians radians(float value) { return {ten_thousandths(value)}; }
base::Ratio2 ratio(float value) { return {static_cast<std::int32_t>(std::clamp(value, 0.0F, 1.0F) * 100 + 0.5F)}; }

// Integer place plus float offset, without losing digits far from the origin.
base::Metres map_coordinate(std::int32_t origin, float offset) {
  const float units = std::clamp(offset, -kFarthest, kFarthest) * static_cast<float>(recon::kMapUnitsPerMetre);
  const std::int64_t place = static_cast<std::int64_t>(origin) + static_cast<std::int64_t>(units);
  const std::int64_t rounded = (place < 0 ? place - 5 : place + 5) / 10;
  constexpr std::int64_t kEdge = 10'000'000;
  return {static_cast<std::int32_t>(std::clamp(rounded, -kEdge, kEdge))};
}

record::AlertReport report_obstacle(const alert::Obstacle& obstacle, record::AlertLevel level, base::Time now) {
  record::AlertReport report;
  report.t = now;
  report.level = level;
  report.bearing = radians(obstacle.bearing());
  report.distance = metres(obstacle.distance);
  if (obstacle.closing && obstacle.ttc < kLongestTtc) {
    report.ttc = base::Duration{ten_thousandths(obstacle.ttc)};
  }
  return report;
}

}  // namespace

record::ObjectState state_of(const recon::ObjectCore& object, base::Time now) {
  if (!object.confirmed) return record::ObjectState::kTentative;
  return now - object.last_seen > kLostAfter ? record::ObjectState::kLost : record::ObjectState::kConfirmed;
}

record::ObjectReport report_object(const recon::ObjectCore& object, const alert::Obstacle& obstacle, base::Time now) {
  const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
  const recon::HeightRange band = object.band.at(cylinder.center, cylinder.radius);
  record::ObjectReport report;
  report.t = now;
  report.id = object.id;
  report.signature = object.signature;
  report.views = object.views;
  report.x = map_coordinate(object.origin.x, cylinder.center.x());
  report.y = map_coordinate(object.origin.y, cylinder.center.y());
  report.radius = metres(cylinder.radius);
  report.z_min = metres(band.z_min);
  report.z_max = metres(band.z_max);
  report.bearing = radians(obstacle.bearing());
  report.distance = metres(obstacle.distance);
  report.confidence = ratio(object.confidence());
  report.state = state_of(object, now);
  return report;
}

record::Position report_pose(const recon::MapPose& pose, const recon::PoseSigma& sigma, base::Time t) {
  constexpr std::int32_t kMicroradians = 1'000'000 / base::Radians::kPerUnit;
  constexpr std::int32_t kHalf = kMicroradians / 2;
  constexpr std::int32_t kEdge = 10'000'000;
  record::Position position;
  position.t = t;
  position.x = map_coordinate(pose.position.x, 0);
  position.y = map_coordinate(pose.position.y, 0);
  const std::int32_t heading = (pose.heading + (pose.heading < 0 ? -kHalf : kHalf)) / kMicroradians;
  position.heading = base::Radians{std::clamp(heading, -kEdge, kEdge)};
  position.sigma_xy = metres(sigma.position);
  position.sigma_heading = radians(sigma.heading);
  return position;
}

record::StatusReport report_status(base::Time now, const Counters& counters, std::uint32_t objects) {
  record::StatusReport report;
  report.t = now;
  report.frames = counters.frames;
  report.blobs = counters.blobs;
  report.blobs_dropped = counters.blobs_dropped;
  report.odometry = counters.odometry;
  report.rejected = counters.rejected;
  report.refused = counters.refused_in_all();
  report.records_dropped = counters.records_dropped;
  report.objects = objects;
  report.loop_us_max = counters.loop_us_max;
  return report;
}

Nearest nearest_of(const alert::Obstacle& obstacle) { return {metres(obstacle.distance), radians(obstacle.bearing())}; }

record::AlertReport report_alert(const recon::ObjectCore& object, const alert::Obstacle& obstacle,
                                 record::AlertLevel level, base::Time now) {
  record::AlertReport report = report_obstacle(obstacle, level, now);
  report.id = object.id;
  report.signature = object.signature;
  report.confidence = ratio(object.confidence());
  return report;
}

record::AlertReport report_alert(const alert::FrontAhead& front, record::AlertLevel level, base::Time now) {
  record::AlertReport report = report_obstacle(front.nearest, level, now);
  report.id = record::kNoObject;
  report.signature = front.signature;
  report.confidence = ratio(front.confidence);
  return report;
}

record::AlertReport report_blind(base::Time now) {
  record::AlertReport report;
  report.t = now;
  report.level = record::AlertLevel::kBlind;
  report.id = record::kNoObject;
  return report;
}

record::AlertReport report_clear(std::uint32_t id, const alert::AlertState& last, base::Time now) {
  record::AlertReport report;
  report.t = now;
  report.level = record::AlertLevel::kClear;
  report.id = id;
  report.signature = last.signature;
  report.bearing = last.bearing;
  report.distance = last.distance;
  return report;
}

}  // namespace fencepost::console
