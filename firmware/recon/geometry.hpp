// Points and directions in the plane. A direction is a unit vector, never an angle.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fencepost::recon {

/// Metres, or a direction. Not initialised unless given values: `Vec2{}` is zero. Not constexpr: g++ would clear whole
/// objects that contain one, by memset, before their members are written.
class Vec2 {
 public:
  Vec2() = default;
  Vec2(float x, float y) : x_(x), y_(y) {}

  [[nodiscard]] float x() const { return x_; }
  [[nodiscard]] float y() const { return y_; }
  float& x() { return x_; }
  float& y() { return y_; }

  Vec2& operator+=(const Vec2& v) { return *this = *this + v; }
  Vec2& operator-=(const Vec2& v) { return *this = *this - v; }
  Vec2& operator*=(float factor) { return *this = *this * factor; }
  Vec2& operator/=(float divisor) { return *this = *this / divisor; }
  friend Vec2 operator-(const Vec2& v) { return {-v.x_, -v.y_}; }
  friend Vec2 operator+(const Vec2& a, const Vec2& b) { return {a.x_ + b.x_, a.y_ + b.y_}; }
  friend Vec2 operator-(const Vec2& a, const Vec2& b) { return {a.x_ - b.x_, a.y_ - b.y_}; }
  friend Vec2 operator*(const Vec2& v, float factor) { return {v.x_ * factor, v.y_ * factor}; }
  friend Vec2 operator*(float factor, const Vec2& v) { return {factor * v.x_, factor * v.y_}; }
  friend Vec2 operator/(const Vec2& v, float divisor) { return {v.x_ / divisor, v.y_ / divisor}; }
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;

  [[nodiscard]] float dot(const Vec2& v) const { return x_ * v.x_ + y_ * v.y_; }
  [[nodiscard]] float squared_norm() const { return dot(*this); }
  [[nodiscard]] float norm() const { return std::sqrt(squared_norm()); }
  [[nodiscard]] Vec2 normalized() const { return *this / norm(); }
  [[nodiscard]] float max_norm() const { return std::max(x_ < 0 ? -x_ : x_, y_ < 0 ? -y_ : y_); }

 private:
  float x_;
  float y_;
};

/// v turned left by a quarter turn.
inline Vec2 left_of(const Vec2& v) { return {-v.y(), v.x()}; }

/// z component of a x b: positive if b is left of a.
inline float cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// `v` rotated by the angle whose cosine and sine are in `rotation`.
inline Vec2 rotated(const Vec2& rotation, const Vec2& v) {
  return {rotation.x() * v.x() - rotation.y() * v.y(), rotation.y() * v.x() + rotation.x() * v.y()};
}

/// A place in the map frame, counted in 10 um: as exact 100 m from the origin as beside it.
struct MapPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(MapPoint, MapPoint) = default;
};

inline constexpr std::int32_t kMapUnitsPerMetre = 100'000;
inline constexpr float kMetresPerMapUnit = 1e-5F;

/// `point` as seen from `origin`, metres, map axes.
inline Vec2 offset_from(MapPoint origin, MapPoint point) {
  return {static_cast<float>(point.x - origin.x) * kMetresPerMapUnit,
          static_cast<float>(point.y - origin.y) * kMetresPerMapUnit};
}

/// The map point nearest to `origin` + `offset`; |offset| below 10 km.
inline MapPoint moved(MapPoint origin, const Vec2& offset) {
  const auto rounded = [](float metres) {
    const float units = metres * static_cast<float>(kMapUnitsPerMetre);
    return static_cast<std::int32_t>(units < 0 ? units - 0.5F : units + 0.5F);
  };
  return {origin.x + rounded(offset.x()), origin.y + rounded(offset.y())};
}

/// Everything with normal . x <= bound. `normal` is a unit vector that points out of the object.
struct HalfPlane {
  Vec2 normal{0, 0};
  float bound = 0;
};

/// The same half plane, coordinates taken from a point `shift` away.
inline HalfPlane seen_from(const HalfPlane& half_plane, const Vec2& shift) {
  return {half_plane.normal, half_plane.bound - half_plane.normal.dot(shift)};
}

}  // namespace fencepost::recon
