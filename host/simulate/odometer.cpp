#include "host/simulate/odometer.hpp"

#include <algorithm>
#include <cmath>

#include "host/simulate/random.hpp"

namespace fencepost::host {

Odometer::Odometer(const Scene& scene, const Trajectory& trajectory) : scene_(scene), trajectory_(trajectory) {
  const SceneNoise& noise = scene.noise;
  reported_ = trajectory.at(0);
  if (noise.pose_xy == 0 && noise.pose_heading == 0) return;
  for (int view = 0; view < trajectory.frames(); ++view) {
    Random random(scene.seed, Purpose::kViewPose, static_cast<std::uint64_t>(view));
    TimedPose offset;
    offset.x = noise.pose_xy * random.gaussian();
    offset.y = noise.pose_xy * random.gaussian();
    offset.heading = noise.pose_heading * random.gaussian();
    offsets_.push_back(offset);
  }
}

sensor::OdometrySample Odometer::next() {
  const base::Time t{step_ * kOdometryPeriod.raw};
  const TimedPose now = trajectory_.at(t.to_double());
  const SceneNoise& noise = scene_.noise;
  drifts_ = drifts_ || noise.drift_scale != 0 || noise.drift_turn != 0 || noise.drift_walk != 0;
  if (!drifts_) {
    reported_ = now;
  } else if (step_ > 0) {
    advance(trajectory_.at(base::Time{t.raw - kOdometryPeriod.raw}.to_double()), now);
  }
  ++step_;
  reported_.t = t.to_double();
  const TimedPose pose = with_view_offset(reported_);
  return {t, base::Metres::nearest(pose.x), base::Metres::nearest(pose.y), base::Radians::nearest(pose.heading)};
}

void Odometer::advance(const TimedPose& before, const TimedPose& now) {
  const SceneNoise& noise = scene_.noise;
  const double dx = now.x - before.x;
  const double dy = now.y - before.y;
  const double distance = std::hypot(dx, dy);
  const double turned = noise.drift_turn * distance;
  // The heading error half way through the step turns the step's direction.
  const double error = reported_.heading - before.heading + turned / 2;
  const double scale = 1 + noise.drift_scale;
  const double c = std::cos(error);
  const double s = std::sin(error);
  Random random(scene_.seed, Purpose::kDrift, static_cast<std::uint64_t>(step_));
  const double walk = noise.drift_walk * std::sqrt(distance);
  reported_.x += scale * (c * dx - s * dy) + walk * random.gaussian();
  reported_.y += scale * (s * dx + c * dy) + walk * random.gaussian();
  reported_.heading += now.heading - before.heading + turned;
}

TimedPose Odometer::with_view_offset(TimedPose pose) const {
  if (offsets_.empty()) return pose;
  const double nearest = std::floor(pose.t * scene_.rate + 0.5);
  const auto view = static_cast<std::size_t>(std::clamp(nearest, 0.0, static_cast<double>(offsets_.size() - 1)));
  pose.x += offsets_[view].x;
  pose.y += offsets_[view].y;
  pose.heading += offsets_[view].heading;
  return pose;
}

}  // namespace fencepost::host
