#include "tests/studies/hazards/route.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace fencepost::test {
namespace {

host::TimedPose along(const host::TimedPose& from, const Leg& leg, double seconds) {
  constexpr double kStraight = 1e-9;  // rad/s
  const double turn = leg.turn_rate * seconds;
  host::TimedPose pose = from;
  pose.t += seconds;
  pose.heading += turn;
  if (std::abs(leg.turn_rate) < kStraight) {
    pose.x += leg.speed * seconds * std::cos(from.heading);
    pose.y += leg.speed * seconds * std::sin(from.heading);
  } else {
    const double radius = leg.speed / leg.turn_rate;
    pose.x += radius * (std::sin(pose.heading) - std::sin(from.heading));
    pose.y -= radius * (std::cos(pose.heading) - std::cos(from.heading));
  }
  return pose;
}

}  // namespace

Route::Route(host::TimedPose start, std::vector<Leg> legs) : legs_(std::move(legs)), start_(start) {
  start.t = 0;
  for (const Leg& leg : legs_) {
    begins_.push_back(start);
    start = along(start, leg, leg.seconds);
  }
}

std::size_t Route::leg_at(double progress) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), progress,
                                      [](double time, const host::TimedPose& begin) { return time < begin.t; });
  return after == begins_.begin() ? 0 : static_cast<std::size_t>(after - begins_.begin()) - 1;
}

host::TimedPose Route::at(double progress) const {
  if (legs_.empty()) return start_;
  const std::size_t leg = leg_at(progress);
  return along(begins_[leg], legs_[leg], std::max(0.0, progress - begins_[leg].t));
}

double Route::speed(double progress) const { return legs_.empty() ? 0 : std::abs(legs_[leg_at(progress)].speed); }

host::TimedPose relative(const host::TimedPose& base, double ahead, double left, double turn) {
  const double c = std::cos(base.heading);
  const double s = std::sin(base.heading);
  return {base.t, base.x + c * ahead - s * left, base.y + s * ahead + c * left, base.heading + turn};
}

}  // namespace fencepost::test
