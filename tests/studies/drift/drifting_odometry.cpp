#include "tests/studies/drift/drifting_odometry.hpp"

#include <cmath>
#include <numbers>

namespace fencepost::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

}  // namespace

DriftingOdometry::DriftingOdometry(unsigned seed, const Drift& drift)
    : random_(seed, host::Purpose::kDrift, 77),
      drift_(drift),
      scale_(1 + drift.scale * random_.gaussian()),
      turn_(drift.turn * kDegree * random_.gaussian()) {}

sensor::OdometrySample DriftingOdometry::next(const sensor::OdometrySample& sample) {
  const host::PoseResult now{sample.t.to_double(), sample.x.to_double(), sample.y.to_double(),
                             sample.heading.to_double()};
  if (truth_.empty()) {
    logged_ = now;
  } else {
    advance(truth_.back(), now);
  }
  truth_.push_back(now);
  return {sample.t, base::Metres::nearest(logged_.x), base::Metres::nearest(logged_.y),
          base::Radians::nearest(logged_.heading)};
}

void DriftingOdometry::advance(const host::PoseResult& before, const host::PoseResult& now) {
  const double dx = now.x - before.x;
  const double dy = now.y - before.y;
  const double distance = std::hypot(dx, dy);
  const double off = logged_.heading - before.heading;
  const double walk = drift_.scale > 0 ? drift_.scale_walk * std::sqrt(distance) * random_.gaussian() : 0;
  const double factor = distance > 0 ? scale_ + walk / distance : 1;
  logged_.x += factor * (std::cos(off) * dx - std::sin(off) * dy);
  logged_.y += factor * (std::sin(off) * dx + std::cos(off) * dy);
  logged_.heading += std::remainder(now.heading - before.heading, 2 * std::numbers::pi) + turn_ * distance +
                     drift_.turn_walk * kDegree * std::sqrt(distance) * random_.gaussian();
}

}  // namespace fencepost::test
