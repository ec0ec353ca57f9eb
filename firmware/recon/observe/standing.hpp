// Since when the robot has not moved: what was clearly seen since then has to be seen still, wherever in the image it
// is.
#pragma once

#include <cstdint>

#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/units.hpp"

namespace fencepost::recon {

class Standing {
 public:
  /// Adds the robot's pose at an exposure, by odometry. A robot whose pose only jitters is stationary.
  void look(const MapPose& odometry, base::Time exposure) {
    const int off = is_within(odometry, 1) ? 0 : is_within(odometry, 2) ? strays_ + 1 : kFewestViews;
    strays_ = static_cast<std::uint8_t>(off);
    const bool stays = exposures_ > 0 && strays_ < kFewestViews;
    if (!stays) {
      exposures_ = 1;
      strays_ = 0;
      place_ = odometry;
      reached_ = exposure;
    }
    stands_ = (stands_ || strays_ == 0) && exposure - reached_ >= kMoment;
    if (stands_ && strays_ == 0) average(odometry);
    since_ = stands_ ? reached_ : exposure;
  }

  /// By the latest frame.
  [[nodiscard]] bool stands() const { return stands_; }
  /// The exposure itself while the robot moves, or may have begun to.
  [[nodiscard]] base::Time since() const { return since_; }

 private:
  // The first pose alone may be the one that is off, or of a robot that still slowed down.
  void average(const MapPose& odometry) {
    if (exposures_ < UINT8_MAX) ++exposures_;
    const auto step = [&](std::int64_t difference) { return static_cast<std::int32_t>(difference / exposures_); };
    place_.position.x += step(std::int64_t{odometry.position.x} - place_.position.x);
    place_.position.y += step(std::int64_t{odometry.position.y} - place_.position.y);
    place_.heading += step(short_way(std::int64_t{odometry.heading} - place_.heading));
  }
  // True if the pose is no farther from the place than that many gates.
  [[nodiscard]] bool is_within(const MapPose& odometry, int gates) const {
    const auto within = [&](std::int64_t difference, std::int64_t gate) {
      return difference <= gates * gate && difference >= -gates * gate;
    };
    return within(std::int64_t{odometry.position.x} - place_.position.x, kStandingNear) &&
           within(std::int64_t{odometry.position.y} - place_.position.y, kStandingNear) &&
           within(short_way(std::int64_t{odometry.heading} - place_.heading), kStandingTurn);
  }

  base::Time since_;
  base::Time reached_;
  MapPose place_;  // mean of `exposures_`
  std::uint8_t exposures_ = 0;
  std::uint8_t strays_ = 0;
  bool stands_ = false;
};

}  // namespace fencepost::recon
