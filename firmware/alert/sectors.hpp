// A virtual lidar: the range from the robot's origin to the nearest thing in equal sectors all around. It uses the map,
// the guard and the floor that was seen empty. For planners that take ranges (VFH, gap following).
//
// A range never ends behind unseen floor, for everything beyond is unknown. Unknown is reported as such and is not
// free.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/alert/obstacle.hpp"
#include "firmware/recon/guard/front.hpp"
#include "firmware/recon/guard/seen_floor.hpp"

namespace fencepost::alert {

inline constexpr std::size_t kSectors = 36;
/// mm. A range is no longer, and then nothing is known to be there.
inline constexpr std::int32_t kLongestRange = recon::guard::kFloorReach;

/// Ranges in mm from the robot's origin; the first sector is centred straight ahead, then counter-clockwise.
class Sectors {
 public:
  /// `odometry`: where the robot is by odometry alone; `body` (mm): floor nearer to its origin is its own.
  Sectors(const recon::guard::SeenFloor& floor, const recon::MapPose& odometry, std::int32_t body);

  /// The guard's points, also those that too few frames have seen to alert. mm from `origin`, odometry's frame.
  void add(std::span<const recon::guard::Front> fronts, recon::MapPoint origin);
  /// An object of the map, with `robot` as corrected.
  template <class Profile>
  void add(const recon::Object<Profile>& object, const RobotPlace& robot) {
    if (!object.used() || object.refuted()) return;
    const auto& hybrid = object.hybrid();
    if (hybrid.ok() && hybrid.known_well) return add_outline({hybrid.outline(), hybrid.origin, true}, robot);
    add_cylinder(object, robot);
  }

  /// Nothing: not known.
  [[nodiscard]] std::optional<std::int32_t> range(std::size_t sector) const;

 private:
  static constexpr std::int32_t kNothing = INT16_MAX;

  void add_cylinder(const recon::ObjectCore& object, const RobotPlace& robot);
  void add_outline(const recon::PlacedOutline& outline, const RobotPlace& robot);
  void put(const recon::Vec2& right, const recon::Vec2& left, float range);
  void put_around(const recon::Vec2& center, float radius, float range);
  void add_sides(const recon::OutlineView& outline, const recon::Vec2& center, const RobotPlace& robot, float nearer);

  std::array<std::int16_t, kSectors> free_{};  ///< how far the floor was seen empty; 0: not at all
  std::array<std::int16_t, kSectors> near_{};  ///< the nearest thing
  RobotPlace odometry_;
};

}  // namespace fencepost::alert
