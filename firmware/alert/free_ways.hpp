// Nine ways that the robot may go next: how far each of them is free, and how fast it may go there.
//
// Known things are those of the map and of the guard; floor that was not seen is unknown, and ends a way as they do.
//
// A way is one of the robot's origin: straight, an arc, or a turn on the spot. It is free until the body and its margin
// touch something. For a program that steers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/alert/alerts.hpp"
#include "firmware/recon/guard/front.hpp"
#include "firmware/recon/guard/seen_floor.hpp"
#include "firmware/record/records.hpp"

namespace fencepost::alert {

/// On which side of a thing the robot has to pass.
enum class PassingSide : std::uint8_t { kAny, kLeft, kRight };

class FreeWays {
 public:
  static constexpr std::size_t kWays = record::WayReport::kMax;

  /// `body`: RobotPath without a motion.
  explicit FreeWays(const RobotPath& body);

  /// The guard's points, also those that too few frames have seen to alert. mm from `origin`; `odometry`: the robot in
  /// the same frame.
  void add(std::span<const recon::guard::Front> fronts, recon::MapPoint origin, const RobotPlace& odometry);
  /// An object of the map, with `robot` as corrected.
  template <class Profile>
  void add(const recon::Object<Profile>& object, const RobotPlace& robot, PassingSide side) {
    if (!object.used() || object.refuted()) return;
    const auto& hybrid = object.hybrid();
    if (hybrid.ok() && hybrid.known_well) return add_outline({hybrid.outline(), hybrid.origin, true}, robot, side);
    add_cylinder(object, robot, side);
  }

  /// After all have been added. `floor` in the frame of `odometry`. For its speed see stopping_speed().
  [[nodiscard]] record::WayReport::Way way(std::size_t index, const recon::guard::SeenFloor& floor,
                                           const RobotPlace& odometry, const AlertRules& rules) const;

 private:
  void add_cylinder(const recon::ObjectCore& object, const RobotPlace& robot, PassingSide side);
  void add_outline(const recon::PlacedOutline& outline, const RobotPlace& robot, PassingSide side);
  // A disc ends the ways that meet it; robot frame. Bit k of `mask`: way k is looked at.
  void put(const recon::Vec2& center, float radius, unsigned mask);
  // Ways that pass this place on the wrong side end beside it.
  void pass(const recon::Vec2& center, PassingSide side);
  // The mask of the ways that a disc would end sooner.
  [[nodiscard]] unsigned met_by(const recon::Vec2& center, float radius) const;
  // m or rad, from here to where the body meets the disc on that way.
  [[nodiscard]] float until(std::size_t index, const recon::Vec2& center, float radius) const;
  // m or rad, no more than `until`: as far as the floor of that way was seen.
  [[nodiscard]] float seen_until(std::size_t index, float until, const recon::guard::SeenFloor& floor,
                                 const RobotPlace& odometry) const;

  RobotPath body_;
  float reach_ = 0;                   ///< m from the origin to the body's farthest corner
  std::array<float, kWays> until_{};  ///< m or rad, to the nearest known thing
};

}  // namespace fencepost::alert
