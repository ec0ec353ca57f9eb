// Which alerts are in force: judged at each frame and at least ten times a second, and ended with their objects.
#pragma once

#include <algorithm>
#include <optional>

#include "firmware/console/reports.hpp"
#include "firmware/loop/memory.hpp"
#include "firmware/loop/reporter.hpp"

namespace fencepost::loop {

/// The robot's speed is that of its latest odometry over this long.
inline constexpr base::Duration kMotionSpan = base::milliseconds(200);

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

  /// Judges all objects as the robot sees them now. Needs odometry.
  [[gnu::noinline]] void watch_path(base::Time now) {
    m_.run.watched_at = base::Stamp(now);
    const alert::RobotPath path = path_ahead();
    const alert::RobotPlace robot(robot_pose(m_));
    const alert::AlertRules rules(m_.settings);
    std::optional<alert::Obstacle> nearest;
    record::AlertLevel highest = record::AlertLevel::kClear;
    for (std::size_t o = 0; o < Profile::kObjects; ++o) {
      const recon::Object<Profile>& object = m_.map.slots()[o];
      if (!object.used()) continue;
      const alert::Obstacle obstacle = see_obstacle(object, robot, path);
      const auto level = judge(m_.alerts[o], object, obstacle, rules, now);
      if (level) emit(m_.alerts[o], console::report_alert(object, obstacle, *level, now));
      highest = std::max(highest, m_.alerts[o].level);
      const bool nearer = !nearest || obstacle.distance < nearest->distance;
      if (obstacle.known && alert::credible(object) && nearer) nearest = obstacle;
    }
    reporter_.plot(nearest, highest, now);
  }

  /// While the camera is silent and the robot still drives, the map goes on warning.
  void watch_without_frames() {
    const bool moving = m_.run.time && !m_.poses.empty();
    if (moving && m_.run.watched_at.since(*m_.run.time) >= alert::kWatchInterval) watch_path(*m_.run.time);
  }

 private:
  // The strip of floor that the robot is about to sweep, by its latest odometry.
  [[nodiscard]] alert::RobotPath path_ahead() const {
    alert::RobotPath path;
    path.motion = m_.poses.motion(kMotionSpan);
    path.body_radius = 0.5F * m_.settings.number(config::Key::kRobotWidth);
    path.half_width = path.body_radius + m_.settings.number(config::Key::kRobotMargin);
    return path;
  }

  void emit(alert::AlertState& state, const record::AlertReport& report) {
    state.signature = report.signature;
    state.distance = report.distance;
    state.bearing = report.bearing;
    reporter_.alert(report);
  }

  Memory<Profile>& m_;
  Reporter<Profile>& reporter_;
};

}  // namespace fencepost::loop
