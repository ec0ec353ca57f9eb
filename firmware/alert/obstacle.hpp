// One object as the moving robot sees it: how near, how soon, in the way or not.
#pragma once

#include <optional>

#include "firmware/alert/swept_area.hpp"
#include "firmware/recon/track/object.hpp"

namespace fencepost::alert {

/// Computed only for an obstacle in the robot's path.
struct InPath {
  float sigma = 0;  ///< m, of the distance
};

/// Robot frame: origin midway between the wheels, x forward, y left.
struct Obstacle {
  bool known = false;        ///< the object has an alert model
  recon::Vec2 toward{0, 0};  ///< m, the middle of the alert model: the nearest point is on the way to it
  float distance = 0;        ///< m, from the robot's origin to the nearest point; 0 inside
  bool cut_off = false;      ///< where it was seen last, an end of it was outside the image or hidden
  bool guessed = false;      ///< it was never surely seen whole: a side of a corridor is no disc in the middle of it
  bool unbacked = false;     ///< the guard should know it and does not: at most a notice
  bool closing = false;
  float closing_speed = 0;  ///< m/s, if closing
  float ttc = 0;            ///< s, until the robot's body touches, if closing
  float overhang = 0;       ///< m, see Overhang: added to the robot's thresholds of distance
  std::optional<InPath> in_path;

  /// rad, of the nearest point
  [[nodiscard]] float bearing() const;
};

/// m that the robot drives until its body touches the obstacle, of which it nears `share` > 0 of a metre in a metre.
float way_to(const RobotPath& path, const Obstacle& obstacle, float share);

/// Fills in how fast the robot nears the obstacle and how soon it is there, by its place.
void set_closing(const RobotPath& path, Obstacle& obstacle);

/// The robot's present pose; its heading as a direction, computed once for all obstacles.
struct RobotPlace {
  explicit RobotPlace(const recon::MapPose& pose);
  /// `away` (m, map axes, from the robot's origin) in the robot frame.
  [[nodiscard]] recon::Vec2 see(const recon::Vec2& away) const {
    return {heading.dot(away), recon::cross(heading, away)};
  }
  recon::MapPoint position;
  recon::Vec2 heading{1, 0};  ///< unit
};

/// Alert model: the cylinder.
Obstacle see_obstacle(const recon::ObjectCore& object, const RobotPlace& robot, const SweptByBody& swept);

/// The same obstacle with the distance to `outline` and its uncertainty there, if that is known well. An outline beside
/// the path is not in it, though the circle around it may be.
void measure_by_outline(const recon::PlacedOutline& outline, const RobotPlace& robot, const SweptByBody& swept,
                        Obstacle& obstacle);

/// Alert model: the hybrid where it is known well, else the cylinder. If the rows have turned out too far, it is the
/// cylinder too. Both models used those rows, and only the cylinder drops them.
template <class Profile>
Obstacle see_obstacle(const recon::Object<Profile>& object, const RobotPlace& robot, const SweptByBody& swept) {
  Obstacle obstacle = see_obstacle(static_cast<const recon::ObjectCore&>(object), robot, swept);
  const bool rows_were_wrong = object.cylinder.row_trend().verdict() == recon::RowVerdict::kTooFar;
  if (obstacle.known && object.hybrid().ok() && !rows_were_wrong) {
    const auto& hybrid = object.hybrid();
    measure_by_outline({hybrid.outline(), hybrid.origin, hybrid.known_well}, robot, swept, obstacle);
  }
  return obstacle;
}

}  // namespace fencepost::alert
