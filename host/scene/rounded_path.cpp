#include "host/scene/rounded_path.hpp"

#include <cmath>
#include <numbers>

namespace fencepost::host {
namespace {

double heading_of(Point a, Point b) { return std::atan2(b.y - a.y, b.x - a.x); }
double length_of(Point a, Point b) { return std::hypot(b.x - a.x, b.y - a.y); }

double turn_at(Point before, Point at, Point after) {
  return std::remainder(heading_of(at, after) - heading_of(before, at), 2 * std::numbers::pi);
}

/// From the corner to where its arc begins and ends.
double tangent_length(const WaypointPath& path, double turn) { return path.turn_radius * std::tan(std::abs(turn) / 2); }

}  // namespace

std::vector<Point> driven_points(const WaypointPath& path) {
  if (path.laps == 0) return path.points;
  std::vector<Point> points;
  for (int lap = 0; lap < path.laps; ++lap) points.insert(points.end(), path.points.begin(), path.points.end());
  points.push_back(path.points.front());
  return points;
}

std::optional<std::size_t> corner_without_room(const WaypointPath& path) {
  constexpr double kRounding = 1e-9;
  const std::vector<Point> points = driven_points(path);
  double taken = 0;  // of the way to the next point, by the arc before
  for (std::size_t i = 1; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    const double own = last ? 0 : tangent_length(path, turn_at(points[i - 1], points[i], points[i + 1]));
    if (taken + own > length_of(points[i - 1], points[i]) + kRounding) return i % path.points.size();
    taken = own;
  }
  return std::nullopt;
}

std::vector<TimedPose> rounded_knots(const WaypointPath& path) {
  constexpr double kStep = 2 * std::numbers::pi / 180;
  const std::vector<Point> points = driven_points(path);
  double heading = heading_of(points[0], points[1]);
  std::vector<TimedPose> knots{{0, points[0].x, points[0].y, heading}};
  if (path.wait > 0) knots.push_back({path.wait, points[0].x, points[0].y, heading});
  const auto drive_to = [&](double x, double y, double way) {
    if (way > 0) knots.push_back({knots.back().t + way / path.speed, x, y, heading});
  };
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double turn = turn_at(points[i - 1], points[i], points[i + 1]);
    const double back = tangent_length(path, turn);
    const double x = points[i].x - back * std::cos(heading);
    const double y = points[i].y - back * std::sin(heading);
    drive_to(x, y, length_of({knots.back().x, knots.back().y}, {x, y}));
    const double side = turn < 0 ? -path.turn_radius : path.turn_radius;
    const Point center{x - side * std::sin(heading), y + side * std::cos(heading)};
    const double start = heading;
    const int steps = static_cast<int>(std::ceil(std::abs(turn) / kStep));
    for (int k = 1; k <= steps; ++k) {
      heading = start + turn * k / steps;
      drive_to(center.x + side * std::sin(heading), center.y - side * std::cos(heading), std::abs(side * turn) / steps);
    }
  }
  const Point last = points.back();
  drive_to(last.x, last.y, length_of({knots.back().x, knots.back().y}, last));
  return knots;
}

}  // namespace fencepost::host
