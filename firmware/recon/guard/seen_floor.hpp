// Which floor around the robot was seen empty lately: a grid of bits that goes with the robot, in the frame of odometry
// alone. What was never seen, or not for some seconds, is unknown and not free.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/recon/floor_frame.hpp"
#include "firmware/recon/guard/tuning.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "hal/base/stamp.hpp"

namespace fencepost::recon::guard {

inline constexpr int kFloorCellLog2 = 6;                         ///< log2 of the cell's side in mm
inline constexpr std::int32_t kFloorCell = 1 << kFloorCellLog2;  ///< mm, the side of a cell
/// mm along the optical axis. Floor beyond this is not evaluated. Derived: as the guard's points.
inline constexpr std::int32_t kFloorReach = kFarthest;
/// Minimum time between two frames that are evaluated.
inline constexpr base::Duration kFloorInterval = base::milliseconds(200);
/// Minimum time for which seen floor is remembered; the maximum is twice that. Derived: a mover may have come since.
inline constexpr base::Duration kFloorRemembered = kOutOfSight;
/// mm, the minimum height of a thing on the floor. With its foot nearer than the lowest row, it is still in the image.
inline constexpr std::int32_t kMinHeight = 60;

class SeenFloor {
 public:
  /// Nothing was seen: a new run, or another calibration.
  void clear() { has_looked_ = false; }

  /// Adds the floor that this frame shows empty: inside its columns, and nearer than the feet of blobs. `robot`: at the
  /// exposure, by odometry. Adds nothing without the camera's pitch and height, or if the camera may have more blobs
  /// than it reports.
  void look(const WaitingFrame& frame, const CameraModel& camera, const MapPose& robot);

  /// Returns how far the floor was seen along a ray without a gap, mm; 0 if it was not seen at `first` mm. It samples
  /// the ray from `first` in steps of `step` mm, up to kFloorReach. `ray`: its axis, in odometry's frame.
  [[nodiscard]] std::int32_t seen_along(const FloorFrame& ray, std::int32_t first, std::int32_t step) const;
  /// mm, odometry's frame.
  [[nodiscard]] bool seen(std::int32_t x, std::int32_t y) const;

 private:
  static constexpr std::int32_t kCells = 64;  ///< to a side: 4 m
  using Rows = std::array<std::uint64_t, kCells>;

  void age(base::Time t);
  void follow(std::int32_t x, std::int32_t y);
  [[nodiscard]] bool holds(std::int32_t x, std::int32_t y) const;

  Rows now_{};
  Rows before_{};
  std::int32_t first_x_ = 0;  ///< the lowest cell of the grid
  std::int32_t first_y_ = 0;
  base::Stamp looked_at_;
  base::Stamp began_at_;  ///< with now_
  bool has_looked_ = false;
};

static_assert(sizeof(SeenFloor) <= 1056);

}  // namespace fencepost::recon::guard
