#include "host/smooth/par.hpp"

#include <cmath>

namespace fencepost::host {

Point FloorMotion::operator()(Point p) const {
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  return {c * p.x - s * p.y + shift.x, s * p.x + c * p.y + shift.y};
}

FloorMotion aligned(std::span<const PointPair> pairs) {
  FloorMotion motion;
  if (pairs.empty()) return motion;
  const auto n = static_cast<double>(pairs.size());
  Point from;
  Point to;
  for (const PointPair& pair : pairs) {
    from = {from.x + pair.from.x / n, from.y + pair.from.y / n};
    to = {to.x + pair.to.x / n, to.y + pair.to.y / n};
  }
  double cosine = 0;
  double sine = 0;
  for (const PointPair& pair : pairs) {
    const Point a{pair.from.x - from.x, pair.from.y - from.y};
    const Point b{pair.to.x - to.x, pair.to.y - to.y};
    cosine += a.x * b.x + a.y * b.y;
    sine += a.x * b.y - a.y * b.x;
  }
  motion.turn = cosine == 0 && sine == 0 ? 0 : std::atan2(sine, cosine);
  const Point turned = motion(from);
  motion.shift = {to.x - turned.x, to.y - turned.y};
  return motion;
}

std::vector<double> distances_after(const FloorMotion& motion, std::span<const PointPair> pairs) {
  std::vector<double> distances;
  for (const PointPair& pair : pairs) {
    const Point moved = motion(pair.from);
    distances.push_back(std::hypot(moved.x - pair.to.x, moved.y - pair.to.y));
  }
  return distances;
}

double rms_of(const std::vector<double>& values) {
  if (values.empty()) return 0;
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace fencepost::host
