// Where a pixel's ray meets the floor, in integers. On a small core all blobs of a frame take as long as one in floats.
#pragma once

#include <cstdint>

#include "firmware/recon/floor_frame.hpp"

namespace fencepost::recon {

struct CameraModel;

/// A ray that falls to the floor. Level camera frame: x along the optical axis, y to the left; mm on the floor.
struct FloorPoint {
  std::int32_t depth = kNowhere;  ///< along the axis; kNowhere: it does not come down within some metres
  std::int32_t slope = 0;         ///< to the left for each mm of depth, counts of 2^-14
  static constexpr std::int32_t kNowhere = 1 << 15;
};

class FloorCamera {
 public:
  FloorCamera() = default;
  explicit FloorCamera(const CameraModel& camera);

  /// The camera's pitch and height are known and its numbers are within what these integers hold.
  [[nodiscard]] bool usable() const { return usable_; }
  /// Where the ray meets the floor; pixel coordinates in halves, for edges lie between pixels.
  [[nodiscard]] FloorPoint at(std::int32_t twice_u, std::int32_t twice_v) const;
  /// The same of two pixels of one row.
  struct Pair {
    FloorPoint left;
    FloorPoint right;
  };
  [[nodiscard]] Pair at(std::int32_t twice_left, std::int32_t twice_right, std::int32_t twice_v) const;
  /// mm of depth that a row is worth at a depth of at most 4 m.
  [[nodiscard]] std::int32_t depth_of_row(std::int32_t depth) const { return ((depth * depth >> 4) * per_row_) >> 16; }
  /// mm across that a column is worth at a depth.
  [[nodiscard]] std::int32_t width_of_column(std::int32_t depth) const { return (depth * (per_px_x_ >> 6)) >> 16; }

  /// A foot nearer than this may be below the image; between these slopes it must be inside its columns. With margins.
  [[nodiscard]] std::int32_t nearest_visible() const { return nearest_visible_; }
  [[nodiscard]] std::int32_t leftmost_visible() const { return leftmost_visible_; }
  [[nodiscard]] std::int32_t rightmost_visible() const { return rightmost_visible_; }

 private:
  /// The values shared by all rays at one undistorted row.
  struct Row {
    std::int32_t forward = 0;
    std::int32_t depth = FloorPoint::kNowhere;
  };
  [[nodiscard]] Row row_at(std::int32_t y) const;
  [[nodiscard]] FloorPoint on(const Row& row, std::int32_t x) const;
  void find_limits(std::int32_t columns, std::int32_t rows);

  bool usable_ = false;
  bool bent_ = false;  ///< the factor for x and y depends on both
  bool equidistant_ = false;
  std::int32_t centre_u_ = 0;  ///< 2^-4 px
  std::int32_t centre_v_ = 0;
  std::int32_t per_px_x_ = 0;  ///< 2^-22 of the focal length's inverse
  std::int32_t per_px_y_ = 0;
  std::int32_t k1_ = 0;
  std::int32_t pitch_cos_ = kSlopeOne;
  std::int32_t pitch_sin_ = 0;
  std::int32_t height_ = 0;   ///< 2^-4 mm
  std::int32_t per_row_ = 0;  ///< 2^20 / (f h), 1 / mm
  std::int32_t nearest_visible_ = 0;
  std::int32_t leftmost_visible_ = 0;
  std::int32_t rightmost_visible_ = 0;
};

}  // namespace fencepost::recon
