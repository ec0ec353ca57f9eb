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
    strays_ = is_near(odometry) ? std::uint8_t{0} : static_cast<std::uint8_t>(strays_ + 1);
    const bool stays = started_ && strays_ < kFewestViews;
    if (!stays) {
      started_ = true;
      strays_ = 0;
      place_ = odometry;
      reached_ = exposure;
    }
    stands_ = strays_ == 0 && exposure - reached_ >= kMoment;
    since_ = stands_ ? reached_ : exposure;
  }

  /// By the latest frame.
  [[nodiscard]] bool stands() const { return stands_; }
  /// The exposure itself while the robot moves, or may have begun to.
  [[nodiscard]] base::Time since() const { return since_; }

 private:
  [[nodiscard]] bool is_near(const MapPose& odometry) const {
    const auto within = [](std::int64_t difference, std::int64_t most) {
      return difference <= most && difference >= -most;
    };
    return within(std::int64_t{odometry.position.x} - place_.position.x, kStandingNear) &&
           within(std::int64_t{odometry.position.y} - place_.position.y, kStandingNear) &&
           within(short_way(std::int64_t{odometry.heading} - place_.heading), kStandingTurn);
  }

  base::Time since_;
  base::Time reached_;
  MapPose place_;
  std::uint8_t strays_ = 0;
  bool started_ = false;
  bool stands_ = false;
};

}  // namespace fencepost::recon
