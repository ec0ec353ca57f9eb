// From pixel columns and rows to directions on the ground plane (host/share/doc/frames.md; formats of the stream).
#pragma once

#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/observe/floor_camera.hpp"
#include "hal/base/units.hpp"
#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::recon {

/// One calibrated camera in floats, ready for use. Frame "level camera": at the lens, x along the optical axis
/// projected on the ground, y left, metres.
struct CameraModel {
  float fx = 1;
  float fy = 1;
  float cx = 0;
  float cy = 0;
  float k1 = 0;
  Vec2 pitch{1, 0};          ///< cosine, sine; looking down is positive
  Vec2 yaw{1, 0};            ///< cosine, sine of the mount's yaw
  Vec2 position{0, 0};       ///< robot frame, m
  float edge_px = 1;         ///< px, sigma of a box edge
  float height = 0;          ///< of the lens above the floor, m
  bool pitch_known = false;  ///< false: ground rows give no depth
  bool bent = false;         ///< straight lines are not straight in the image
  bool equidistant = false;
  std::int16_t width = 2;
  std::int16_t rows = 2;
  base::Duration latency;
  FloorCamera floor;  ///< the same numbers, for the floor
};

/// px, default sigma of a box edge of a camera with this many columns.
float nominal_edge_noise(std::int16_t columns);

CameraModel make_camera_model(const sensor::CameraIntrinsics& intrinsics);

/// The four numbers of a box that reconstruction needs; inclusive pixel coordinates.
struct Box {
  std::int16_t x1 = 0;
  std::int16_t y1 = 0;
  std::int16_t x2 = 0;
  std::int16_t y2 = 0;
};

/// Continuous edges of inclusive pixel coordinates, px.
inline float left_edge(const Box& box) { return static_cast<float>(box.x1) - 0.5F; }
inline float right_edge(const Box& box) { return static_cast<float>(box.x2) + 0.5F; }
inline float top_edge(const Box& box) { return static_cast<float>(box.y1) - 0.5F; }
inline float bottom_edge(const Box& box) { return static_cast<float>(box.y2) + 0.5F; }

/// A flag for each side of a box.
struct Sides {
  bool left = false;
  bool right = false;
  bool top = false;
  bool bottom = false;
};

/// Within one pixel of the image's border (x1 <= 1, x2 >= width-2; rows y1 <= 1, y2 >= rows-2) the object may go on
/// outside the image.
Sides cut_by_border(const CameraModel& camera, const Box& box);

/// The box with `pad` px off each side; below 0: added, inside the image. A side that the border cuts stays: it is no
/// edge of the object. At least a column and a row are left, in the middle of what was.
Box without_pad(const CameraModel& camera, const Box& box, std::int16_t pad);

/// The row (px) in which an edge of a box is where it is. Straight lines are bows through a fisheye: an outer edge
/// reaches farthest nearest to the horizon, an inner one farthest from it. Other lenses: the middle row.
float row_of_edge(const CameraModel& camera, const Box& box, bool left);

/// The pixel positions of one row: without distortion they have half of the work in common.
class PixelRow {
 public:
  PixelRow(const CameraModel& camera, float v);
  /// The direction to a pixel position, on the ground plane: unit, level camera frame.
  [[nodiscard]] Vec2 ground_direction(float u) const;
  /// Where a pixel position of the real camera is in the level one: its column_of(), whole pixels.
  [[nodiscard]] std::int16_t level_column(float u) const;

 private:
  [[nodiscard]] Vec2 towards(float u) const;

  const CameraModel& camera_;
  float v_;
  float forward_;  // if there is no distortion
};

inline Vec2 ground_direction(const CameraModel& camera, float u, float v) {
  return PixelRow(camera, v).ground_direction(u);
}

/// How far the ray through a pixel position falls below the horizontal for each metre of forward depth, m/m.
float drop_per_depth(const CameraModel& camera, float u, float v);

/// Undistorted normalised coordinates of a pixel position: x right, y down, at depth 1.
/// Inverts r_d = r_u (1 + k1 r_u^2) with a fixed number of Newton steps. What an equidistant lens sees beyond 80
/// degrees from its axis counts as 80 degrees.
Vec2 undistort(const CameraModel& camera, float u, float v);

/// Nearest whole pixel; far outside the image it stays inside 16 bits.
std::int16_t whole_pixels(float value);

/// Column where a direction of the level camera frame appears on the row of the horizon. A direction to the side or
/// backwards is clamped to far outside the image. For prediction; a pinhole's distortion is left out.
float column_of(const CameraModel& camera, const Vec2& direction);

/// Columns a radian of bearing there, on the row of the horizon.
float columns_per_radian(const CameraModel& camera, const Vec2& direction);

/// Row where something appears that is `drop` below the horizon and `across` to the left for each metre of forward
/// depth. False if it is behind the image. For prediction, as column_of().
bool row_of(const CameraModel& camera, float drop, float across, float& row);

}  // namespace fencepost::recon
