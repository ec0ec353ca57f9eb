#include "host/scene/robot_body.hpp"

#include <algorithm>
#include <cmath>

#include "host/scene/read_scene.hpp"

namespace fencepost::host {
namespace {

constexpr double kLongest = 5;  // m, the range of robot.front, robot.rear and robot.width
constexpr double kShortest = 0.01;

int hundredths(double metres) {
  constexpr double kRounding = 1e-6;  // of 0.29 x 100
  return std::max(1, static_cast<int>(std::ceil(100 * metres - kRounding)));
}

// The rectangle goes around the origin: a body beside it was measured from another point.
void check_place(const JsonNode& node, const LinearRing& footprint) {
  const auto [rear, front] =
      std::minmax_element(footprint.begin(), footprint.end(), [](Point a, Point b) { return a.x < b.x; });
  const auto [right, left] =
      std::minmax_element(footprint.begin(), footprint.end(), [](Point a, Point b) { return a.y < b.y; });
  if (front->x < 0 || rear->x > 0 || left->y < 0 || right->y > 0) {
    node.fail("the robot's origin is not inside or level with it",
              "measure from the point midway between the wheels, x forward, y to the left");
  }
}

}  // namespace

BodyRectangle rectangle_around(const LinearRing& footprint) {
  double front = 0;
  double rear = 0;
  double aside = 0;
  for (const Point& corner : footprint) {
    front = std::max(front, corner.x);
    rear = std::max(rear, -corner.x);
    aside = std::max(aside, std::abs(corner.y));
  }
  return {hundredths(front), hundredths(rear), std::max(2, hundredths(2 * aside))};
}

RobotBody read_robot_body(const JsonNode& node) {
  node.expect_keys({"front", "rear", "width", "footprint"});
  RobotBody body;
  if (const auto front = node.find("front")) body.front = front->number(kShortest, kLongest, "m");
  if (const auto rear = node.find("rear")) body.rear = rear->number(kShortest, kLongest, "m");
  if (const auto width = node.find("width")) body.width = width->number(kShortest, 2 * kLongest, "m");
  const auto footprint = node.find("footprint");
  if (!footprint) return body;
  if (body.front || body.rear || body.width) {
    footprint->fail("says the same as front, rear and width", "give either the one or the others");
  }
  body.footprint = read_outline(*footprint);
  for (std::size_t i = 0; i < body.footprint.size(); ++i) {
    const JsonNode corner = footprint->at(i);
    static_cast<void>(corner.at(std::size_t{0}).number(-kLongest, kLongest, "m"));
    static_cast<void>(corner.at(std::size_t{1}).number(-kLongest / 2, kLongest / 2, "m"));
  }
  check_place(*footprint, body.footprint);
  return body;
}

}  // namespace fencepost::host
