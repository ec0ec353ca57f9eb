// The robot's body on the floor, by its settings.
#pragma once

#include <algorithm>
#include <cmath>

#include "firmware/config/settings.hpp"
#include "host/geometry/polygon.hpp"

namespace fencepost::host::exports {

/// Robot frame, m. An end without a configured length is a half circle, as for the alerts.
struct RobotBody {
  double half_width = 0;
  double front = 0;
  double rear = 0;
  bool round_front = false;
  bool round_rear = false;

  [[nodiscard]] double reach() const { return std::hypot(std::max(front, rear), half_width); }
  [[nodiscard]] bool covers(Point p) const {
    if (std::abs(p.y) > half_width) return false;
    const bool ahead = p.x >= 0;
    if (ahead ? round_front : round_rear) return std::hypot(p.x, p.y) <= half_width;
    return ahead ? p.x <= front : -p.x <= rear;
  }
};

inline RobotBody body_of(const config::Settings& settings) {
  const auto metres = [&](config::Key key) { return static_cast<double>(settings.number(key)); };
  RobotBody body;
  body.half_width = metres(config::Key::kRobotWidth) / 2;
  body.round_front = metres(config::Key::kRobotFront) == 0;
  body.round_rear = metres(config::Key::kRobotRear) == 0;
  body.front = body.round_front ? body.half_width : metres(config::Key::kRobotFront);
  body.rear = body.round_rear ? body.half_width : metres(config::Key::kRobotRear);
  return body;
}

}  // namespace fencepost::host::exports
