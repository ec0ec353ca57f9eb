// Which alerts are in force: judged at each frame and at least ten times a second, and ended with their objects.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "firmware/alert/known_room.hpp"
#include "firmware/console/map_shape.hpp"
#include "firmware/console/reports.hpp"
#include "firmware/loop/memory.hpp"
#include "firmware/loop/reporter.hpp"

namespace fencepost::loop {

/// The robot's speed is that of its latest odometry over this long.
inline constexpr base::Duration kMotionSpan = base::milliseconds(200);
/// Time span of the odometry that gives the path. More: a turn is known later; less: jitter of odometry bends the path.
/// Between two boxes 200 ms make 33 false stops in 10 min, 400 ms 20. Hazard table (passing).
inline constexpr base::Duration kPathSpan = base::milliseconds(400);

template <class Profile>
class PathWatch {
 public:
  PathWatch(Memory<Profile>& memory, Reporter<Profile>& reporter) : m_(memory), reporter_(reporter) {}

  /// After a frame: an alert ends with its object, and a new object in its slot inherits no alert or report state.
  [[gnu::noinline]] void follow_objects(base::Time now) {
    for (const recon::ObjectEvent& event : m_.map.events()) {
      if (event.kind == recon::EventKind::kMoved) continue;
      alert::AlertState& state = m_.alerts[event.slot];
      if (ends(event.kind) && state.in_force()) reporter_.alert(console::report_clear(event.id, state, now));
      state = {};
      m_.reports[event.slot] = {};
    }
  }

  /// After a frame: checks the camera's configuration.
  [[gnu::noinline]] void judge_camera(base::Time now) {
    alert::RowVotes votes;
    for (const recon::ObjectCore& object : m_.map.slots_in_use()) votes.add(object);
    if (m_.camera_doubt.judge(votes, m_.map.lens_check().error(), now)) reporter_.camera_doubt();
  }

  /// Judges all objects as the robot sees them now. Without odometry there is only one thing to say.
  [[gnu::noinline]] void watch_path(base::Time now) {
    m_.run.watched_at = base::Stamp(now);
    m_.run.speed_limit = -1;
    const alert::AlertRules rules(m_.settings, m_.camera_doubt.caution());
    const bool blind = watch_sight(rules, now);
    if (m_.poses.empty()) return plot(std::nullopt, now);
    const recon::Motion motion = motion_now(now);
    m_.run.last_way.follow(motion);
    const alert::RobotPath path = path_ahead(motion);
    const alert::SweptByBody swept(path);
    const recon::MapPose pose = robot_pose(m_);
    const alert::RobotPlace robot(pose);
    m_.trail.push(console::millimetres(pose.position));
    const bool corrected = pose != m_.poses.latest();
    const alert::RobotPlace by_odometry = corrected ? alert::RobotPlace(m_.poses.latest()) : robot;
    const alert::FrontAhead front = fronts_ahead(by_odometry, path, rules, now);
    std::optional<alert::Obstacle> nearest;
    float speed = front.speed;
    record::AlertLevel highest = record::AlertLevel::kClear;
    const auto objects = m_.map.slots_in_use();
    for (std::size_t o = 0; o < objects.size(); ++o) {
      const recon::Object<Profile>& object = objects[o];
      if (!object.used()) continue;
      alert::Obstacle obstacle = see_obstacle(object, robot, swept);
      obstacle.unbacked = sees_floor() && unbacked(object, obstacle, front, by_odometry);
      const auto level = judge(m_.alerts[o], object, obstacle, rules, now);
      if (level) emit(m_.alerts[o], console::report_alert(object, obstacle, *level, now));
      highest = std::max(highest, m_.alerts[o].level);
      if (!obstacle.known || !alert::credible(object)) continue;
      if (!nearest || obstacle.distance < nearest->distance) nearest = obstacle;
      speed = std::min(speed, stopping_speed(obstacle, path, rules));
    }
    limit_speed(speed, rules);
    if (!blind) watch_fronts(front, rules, highest, now);
    const bool nearer = !nearest || front.nearest.distance < nearest->distance;
    if (front.nearest.known && m_.front_alert.in_force() && nearer) nearest = front.nearest;
    plot(nearest, now);
  }

  /// While the camera is silent and the robot still drives, the map goes on warning.
  void watch_without_frames() {
    if (!m_.run.time) return;
    const bool due = m_.run.watched_at.since(*m_.run.time) >= alert::kWatchInterval;
    if (due || turns_blind(*m_.run.time)) watch_path(*m_.run.time);
  }
  /// There is something to say before the path is watched again.
  [[nodiscard]] bool turns_blind(base::Time now) const {
    if (m_.front_alert.level == record::AlertLevel::kBlind) return false;
    return blindness(now) != alert::Blindness::kNone;
  }

  /// The maximum speed of the robot while that is in force: 0 at STOP.
  [[nodiscard]] record::SpeedLimit speed_limit(const record::Heartbeat& beat) const {
    if (beat.level == record::AlertLevel::kBlind) return {beat.t, std::nullopt};
    if (beat.level == record::AlertLevel::kStop) return {beat.t, base::Metres{}};
    if (m_.run.speed_limit < 0) return {beat.t, std::nullopt};
    return {beat.t, base::Metres{m_.run.speed_limit * (base::Metres::kPerUnit / 1000)}};
  }

  /// The level and the link states in force now.
  [[nodiscard]] record::Heartbeat heartbeat(base::Time now) const {
    record::AlertLevel level = m_.front_alert.level;
    for (const alert::AlertState& state : m_.alerts) level = std::max(level, state.level);
    if (m_.run.sight.nothing_seen()) level = record::AlertLevel::kBlind;
    const bool stands = blindness(now) == alert::Blindness::kNone;  // then no input is overdue, either way
    return {now, level, m_.run.sight.camera_state(now, stands), m_.run.sight.odometry_state(now, stands)};
  }

 private:
  [[nodiscard]] bool sees_floor() const { return m_.calibration.models[m_.calibration.current].floor.usable(); }

  // The strip of floor that the robot is about to sweep, by its latest odometry.
  [[nodiscard]] alert::RobotPath path_ahead(const recon::Motion& motion) const {
    alert::RobotPath path = body_of(m_.settings);
    path.motion = motion;
    path.last = m_.run.last_way;
    return path;
  }

  // Jitter of odometry does not move a stationary robot.
  [[nodiscard]] recon::Motion motion_now(base::Time now) const {
    const bool fresh = m_.run.last_frame && now - *m_.run.last_frame < alert::kMinOverdue;
    if (fresh && m_.map.stands()) return {};
    return m_.poses.motion(kPathSpan);
  }

  // With nothing in the path, the limit is that before something at the end of the known floor. Without the floor it is
  // then not known, for only objects are.
  void limit_speed(float speed, const alert::AlertRules& rules) {
    const float farthest = alert::stopping_speed(alert::kFarthestKnown, rules.ttc_stop, alert::kFarthestKnown);
    if (speed > farthest && !sees_floor()) return;
    speed = std::min(speed, farthest);
    const float told = speed > alert::kStanding ? speed : 0.0F;
    m_.run.speed_limit = static_cast<std::int16_t>(recon::kMillimetresPerMetre * told);
  }

  void plot(const std::optional<alert::Obstacle>& nearest, base::Time now) {
    if (reporter_.plots(now)) reporter_.plot(nearest, heartbeat(now));
  }

  // The longer times of a stationary robot are checked only when an input is overdue for a moving one.
  [[nodiscard]] alert::Blindness blindness(base::Time now) const {
    const alert::Blindness moving = m_.run.sight.blindness(now, false);
    if (moving == alert::Blindness::kNone || !standing()) return moving;
    return m_.run.sight.blindness(now, true);
  }

  [[nodiscard]] bool standing() const {
    const recon::Motion motion = m_.poses.motion(kMotionSpan);
    return std::fabs(motion.forward) <= alert::kStanding && std::fabs(motion.turn) <= alert::kNotTurning;
  }

  // True: the robot cannot know what is ahead, which is said until it can.
  bool watch_sight(const alert::AlertRules& rules, base::Time now) {
    const alert::Blindness reason = blindness(now);
    if (reason == alert::Blindness::kNone) return false;
    alert::AlertState& state = m_.front_alert;
    const base::Duration interval = standing() ? alert::kStandingBlind : rules.repeat;
    if (state.level == record::AlertLevel::kBlind && state.reported_at.since(now) < interval) return true;
    state = {};
    state.level = record::AlertLevel::kBlind;
    state.reported_at = base::Stamp(now);
    reporter_.blind(reason, now);
    return true;
  }

  // True if the guard, which sees all feet on the floor, has no point where the object should be. An object never seen
  // whole may be anywhere in the path. Things above the floor or too far away the guard cannot know.
  [[nodiscard]] bool unbacked(const recon::ObjectCore& object, const alert::Obstacle& obstacle,
                              const alert::FrontAhead& front, const alert::RobotPlace& by_odometry) const {
    if (obstacle.guessed) return !front.something;
    if (!obstacle.in_path || obstacle.distance >= alert::kGuardReach) return false;
    if (object.cylinder.row_trend().verdict() == recon::RowVerdict::kTooFar) return false;
    const auto& guard = m_.map.guard();
    const recon::CylinderEstimate& cylinder = object.cylinder.estimate();
    const float reach = cylinder.radius + alert::kSeenWhole.sigmas * cylinder.outline_sigma();
    return !front_within(guard.fronts(), guard.origin(), by_odometry, obstacle.toward, reach);
  }

  // Static things by the guard, which knows odometry's frame only, and things that approach by themselves.
  [[nodiscard]] alert::FrontAhead fronts_ahead(const alert::RobotPlace& robot, const alert::RobotPath& path,
                                               const alert::AlertRules& rules, base::Time now) const {
    const auto& guard = m_.map.guard();
    const recon::CameraModel& camera = m_.calibration.models[m_.calibration.current];
    return more_urgent(see_fronts(guard.fronts(), guard.origin(), robot, path, rules),
                       m_.looming.ahead(camera, path, rules, now));
  }

  // A robot that was blind judges anew, and says so if there is nothing else to say.
  void watch_fronts(const alert::FrontAhead& front, const alert::AlertRules& rules, record::AlertLevel others,
                    base::Time now) {
    alert::AlertState& state = m_.front_alert;
    const bool was_blind = state.level == record::AlertLevel::kBlind;
    if (was_blind) state = {};
    auto level = judge(state, front, others, rules, now);
    if (was_blind && !level) level = record::AlertLevel::kClear;
    if (level && front.nearest.known && *level != record::AlertLevel::kClear) {
      emit(state, console::report_alert(front, *level, now));
    } else if (level && *level != record::AlertLevel::kClear) {
      // It eases, and is in force until it has: what is repeated is where that was last.
      record::AlertReport last = console::report_clear(record::kNoObject, state, now);
      last.level = *level;
      reporter_.alert(last, state);
    } else if (level) {
      state.said = record::AlertLevel::kClear;
      reporter_.alert(console::report_clear(record::kNoObject, state, now));
    }
  }

  void emit(alert::AlertState& state, const record::AlertReport& report) {
    state.signature = report.signature;
    state.distance = report.distance;
    state.bearing = report.bearing;
    reporter_.alert(report, state);
  }

  Memory<Profile>& m_;
  Reporter<Profile>& reporter_;
};

}  // namespace fencepost::loop
