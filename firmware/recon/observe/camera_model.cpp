#include "firmware/recon/observe/camera_model.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

// Along one axis. A pad of more than half of it leaves its middle.
void narrow(std::int16_t& low, std::int16_t& high, std::int16_t pad, bool low_moves, bool high_moves, int last) {
  const int ends = (low_moves ? 1 : 0) + (high_moves ? 1 : 0);
  if (ends == 0) return;
  const int off = std::min<int>(pad, (high - low) / ends);
  if (low_moves) low = static_cast<std::int16_t>(std::max(low + off, 0));
  if (high_moves) high = static_cast<std::int16_t>(std::min(high - off, last));
}

Vec2 direction_of_angle(base::Radians angle) {
  const base::SinCos sc = base::sincos_urad(static_cast<std::int64_t>(angle.raw) * 100);
  return {sc.cos, sc.sin};
}

// How far the ray at a normalised row goes along the ground for each metre along the optical axis.
float forward_at(const CameraModel& camera, float y) { return camera.pitch.x() - y * camera.pitch.y(); }

// tan(angle) from 0 to 80 degrees, by its continued fraction: 6e-6 of itself off at 75 degrees, 1e-4 at 80.
float tangent(float angle) {
  constexpr float kWidest = 1.3963F;
  const float a = std::min(angle, kWidest);
  const float square = a * a;
  return a * (945 + square * (square - 105)) / (945 + square * (15 * square - 420));
}

// The distance from the principal point, in focal lengths, of a ray at an angle to the axis of an equidistant lens.
float equidistant_radius(const CameraModel& camera, float angle) { return angle * (1 + camera.k1 * angle * angle); }

}  // namespace

float nominal_edge_noise(std::int16_t columns) {
  return std::clamp(kEdgeNoise * static_cast<float>(columns) / kNoiseColumns, kMinEdgeNoise, kEdgeNoise);
}

CameraModel make_camera_model(const sensor::CameraIntrinsics& intrinsics) {
  CameraModel camera;
  camera.fx = intrinsics.fx.to_float();
  camera.fy = intrinsics.fy.to_float();
  camera.cx = intrinsics.cx.to_float();
  camera.cy = intrinsics.cy.to_float();
  camera.k1 = intrinsics.k1.to_float();
  camera.equidistant = intrinsics.lens == sensor::Lens::kEquidistant;
  camera.bent = camera.equidistant || camera.k1 != 0;
  camera.pitch_known = intrinsics.mount.pitch.has_value();
  camera.pitch = camera.pitch_known ? direction_of_angle(*intrinsics.mount.pitch) : Vec2{1, 0};
  camera.yaw = direction_of_angle(intrinsics.mount.yaw);
  camera.position = {intrinsics.mount.x.to_float(), intrinsics.mount.y.to_float()};
  camera.height = intrinsics.mount.z.to_float();
  camera.width = static_cast<std::int16_t>(intrinsics.width);
  camera.rows = static_cast<std::int16_t>(intrinsics.height);
  camera.latency = intrinsics.latency;
  camera.edge_px = nominal_edge_noise(camera.width);
  camera.floor = FloorCamera(camera);
  return camera;
}

Vec2 undistort(const CameraModel& camera, float u, float v) {
  const Vec2 distorted{(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy};
  if (!camera.bent) return distorted;
  const float r_d = distorted.norm();
  if (r_d == 0) return distorted;
  float r = r_d;
  for (int step = 0; camera.k1 != 0 && step < kUndistortSteps; ++step) {
    const float slope = 1 + 3 * camera.k1 * r * r;
    if (slope < 0.2F) break;  // beyond the fold of a strong barrel lens: keep the last good value
    r -= (r * (1 + camera.k1 * r * r) - r_d) / slope;
  }
  if (camera.equidistant) r = tangent(r);
  return distorted * (r / r_d);
}

Sides cut_by_border(const CameraModel& camera, const Box& box) {
  return {box.x1 <= kBorderPixels, box.x2 >= camera.width - 1 - kBorderPixels, box.y1 <= kBorderPixels,
          box.y2 >= camera.rows - 1 - kBorderPixels};
}

Box without_pad(const CameraModel& camera, const Box& box, std::int16_t pad) {
  const Sides cut = cut_by_border(camera, box);
  Box bare = box;
  narrow(bare.x1, bare.x2, pad, !cut.left, !cut.right, camera.width - 1);
  narrow(bare.y1, bare.y2, pad, !cut.top, !cut.bottom, camera.rows - 1);
  return bare;
}

float row_of_edge(const CameraModel& camera, const Box& box, bool left) {
  const float top = top_edge(box);
  const float bottom = bottom_edge(box);
  if (!camera.equidistant) return 0.5F * (top + bottom);
  const float horizon = camera.cy - camera.fy * camera.pitch.y();
  const bool outer = left ? left_edge(box) < camera.cx : right_edge(box) > camera.cx;
  if (outer) return std::clamp(horizon, top, bottom);
  return horizon - top > bottom - horizon ? top : bottom;
}

PixelRow::PixelRow(const CameraModel& camera, float v)
    : camera_(camera), v_(v), forward_(camera.bent ? 0.0F : forward_at(camera, (v - camera.cy) / camera.fy)) {}

Vec2 PixelRow::towards(float u) const {
  if (!camera_.bent) return {forward_, -((u - camera_.cx) / camera_.fx)};
  const Vec2 normalised = undistort(camera_, u, v_);
  return {forward_at(camera_, normalised.y()), -normalised.x()};
}

Vec2 PixelRow::ground_direction(float u) const {
  const Vec2 direction = towards(u);
  return direction.normalized();
}

std::int16_t PixelRow::level_column(float u) const { return whole_pixels(column_of(camera_, towards(u))); }

float drop_per_depth(const CameraModel& camera, float u, float v) {
  const float y = camera.bent ? undistort(camera, u, v).y() : (v - camera.cy) / camera.fy;
  return (camera.pitch.y() + y * camera.pitch.x()) / (camera.pitch.x() - y * camera.pitch.y());
}

std::int16_t whole_pixels(float value) {
  constexpr float kFarOutside = 30'000.0F;
  if (!(std::fabs(value) < kFarOutside)) return static_cast<std::int16_t>(value < 0 ? -kFarOutside : kFarOutside);
  return static_cast<std::int16_t>(nearest_whole(value));
}

float column_of(const CameraModel& camera, const Vec2& direction) {
  if (camera.equidistant) {
    return camera.cx - camera.fx * equidistant_radius(camera, base::atan2_rad(direction.y(), direction.x()));
  }
  constexpr float kFarOutside = 1e5F;
  constexpr float kMinForward = 1e-3F;  // of a unit direction: with less it cannot be in the image
  if (direction.x() < kMinForward) return direction.y() > 0 ? -kFarOutside : kFarOutside;
  return camera.cx - camera.fx * direction.y() / direction.x();
}

float columns_per_radian(const CameraModel& camera, const Vec2& direction) {
  if (!camera.equidistant) return camera.fx * direction.squared_norm() / (direction.x() * direction.x());
  if (camera.k1 == 0) return camera.fx;
  const float angle = base::atan2_rad(direction.y(), direction.x());
  return camera.fx * (1 + 3 * camera.k1 * angle * angle);
}

bool row_of(const CameraModel& camera, float drop, float across, float& row) {
  const float along = camera.pitch.x() + drop * camera.pitch.y();
  if (!(along > 0)) return false;
  const float down = drop * camera.pitch.x() - camera.pitch.y();
  if (!camera.equidistant) {
    row = camera.cy + camera.fy * down / along;
    return true;
  }
  const float radius = std::sqrt(across * across + down * down);
  const float bent = equidistant_radius(camera, base::atan2_rad(radius, along));
  row = camera.cy + (radius > 0 ? camera.fy * down * bent / radius : 0.0F);
  return true;
}

}  // namespace fencepost::recon
