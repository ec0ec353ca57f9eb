#include "firmware/recon/observe/camera_model.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/recon/observe/tuning.hpp"
#include "hal/base/trig.hpp"

namespace fencepost::recon {
namespace {

Vec2 direction_of_angle(base::Radians angle) {
  const base::SinCos sc = base::sincos_urad(static_cast<std::int64_t>(angle.raw) * 100);
  return {sc.cos, sc.sin};
}

// How far the ray at a normalised row goes along the ground for each metre along the optical axis.
float forward_at(const CameraModel& camera, float y) { return camera.pitch.x() - y * camera.pitch.y(); }

}  // namespace

float nominal_edge_noise(std::int16_t columns) {
  return std::clamp(kEdgeNoise * static_cast<float>(columns) / kNoiseColumns, kLeastEdgeNoise, kEdgeNoise);
}

CameraModel make_camera_model(const sensor::CameraIntrinsics& intrinsics) {
  CameraModel camera;
  camera.fx = intrinsics.fx.to_float();
  camera.fy = intrinsics.fy.to_float();
  camera.cx = intrinsics.cx.to_float();
  camera.cy = intrinsics.cy.to_float();
  camera.k1 = intrinsics.k1.to_float();
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
  if (camera.k1 == 0) return distorted;
  const float r_d = std::sqrt(distorted.squaredNorm());
  if (r_d == 0) return distorted;
  float r = r_d;
  for (int step = 0; step < kUndistortSteps; ++step) {
    const float slope = 1 + 3 * camera.k1 * r * r;
    if (slope < 0.2F) break;  // beyond the fold of a strong barrel lens: keep the last good value
    r -= (r * (1 + camera.k1 * r * r) - r_d) / slope;
  }
  return distorted * (r / r_d);
}

Sides cut_by_border(const CameraModel& camera, const Box& box) {
  return {box.x1 <= kBorderPixels, box.x2 >= camera.width - 1 - kBorderPixels, box.y1 <= kBorderPixels,
          box.y2 >= camera.rows - 1 - kBorderPixels};
}

PixelRow::PixelRow(const CameraModel& camera, float v)
    : camera_(camera), v_(v), forward_(camera.k1 == 0 ? forward_at(camera, (v - camera.cy) / camera.fy) : 0.0F) {}

Vec2 PixelRow::towards(float u) const {
  if (camera_.k1 == 0) return {forward_, -((u - camera_.cx) / camera_.fx)};
  const Vec2 normalised = undistort(camera_, u, v_);
  return {forward_at(camera_, normalised.y()), -normalised.x()};
}

Vec2 PixelRow::ground_direction(float u) const {
  const Vec2 direction = towards(u);
  return direction / std::sqrt(direction.squaredNorm());
}

std::int16_t PixelRow::level_column(float u) const { return whole_pixels(column_of(camera_, towards(u))); }

float drop_per_depth(const CameraModel& camera, float u, float v) {
  const float y = camera.k1 == 0 ? (v - camera.cy) / camera.fy : undistort(camera, u, v).y();
  return (camera.pitch.y() + y * camera.pitch.x()) / (camera.pitch.x() - y * camera.pitch.y());
}

std::int16_t whole_pixels(float value) {
  constexpr float kFarOutside = 30'000.0F;
  if (!(std::fabs(value) < kFarOutside)) return static_cast<std::int16_t>(value < 0 ? -kFarOutside : kFarOutside);
  return static_cast<std::int16_t>(value + std::copysign(0.5F, value));
}

float column_of(const CameraModel& camera, const Vec2& direction) {
  constexpr float kFarOutside = 1e5F;
  constexpr float kLeastForward = 1e-3F;  // of a unit direction: with less it cannot be in the image
  if (direction.x() < kLeastForward) return direction.y() > 0 ? -kFarOutside : kFarOutside;
  return camera.cx - camera.fx * direction.y() / direction.x();
}

}  // namespace fencepost::recon
