// The floor that the robot is about to sweep: its body and margin, moved on along the ways that lead on from here.
//
// Straight on, that is a strip as wide as the body and its margin. On an arc it is a ring around the pivot. The ring
// begins at the body's inner side and ends at the circle of its corners. These are farther from the pivot than the
// body's side: nose and tail swing out. A robot that spins sweeps a circle. A place beside the body is passed only when
// it is behind the last corner. A round end has no corners, and a place beside it is passed.
//
// Robot frame. Per place two comparisons on a straight way, two products on an arc; no root.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "firmware/alert/robot_path.hpp"
#include "firmware/recon/geometry.hpp"

namespace fencepost::alert {

/// Length by which the robot's body reaches farther than half its width, m. It is added to thresholds of distance from
/// the robot's origin. Never negative. On the side that leads the edge counts; on a side that only swings out, or in a
/// spin, the corners count.
struct Overhang {
  Overhang() = default;
  Overhang(const RobotPath& path, const Ways& ways);
  float ahead = 0;
  float behind = 0;
};

/// One end's corners in a turn, m and m^2.
struct Corners {
  Corners() = default;
  /// `length` from the origin to the end; 0: it has none. `radius` of the origin's way, not negative.
  Corners(const RobotPath& path, float margin, float length, float radius);
  float length = 0;
  float out = 0;     ///< farther from the pivot than the body's side
  float square = 0;  ///< the same with the margin, as a difference of squares
};

/// In one unit: m, or mm.
template <class Number>
struct SweptBounds {
  /// One end of the body.
  struct End {
    Number beside = 0;  ///< maximum distance that way of a place beside the body, on the outer side of a turn
    Number passed = 0;  ///< minimum distance that way of a place that is passed when the other end leads
    Number outer = 0;   ///< like `outer`, of this end's corners alone
  };
  Number half_width = 0;
  Number middle = 0;  ///< nearer to the body's middle line, behind the origin, nothing can be: it was seen wrong
  Number inner = 0;   ///< bounds of what is |place - pivot|^2 - radius^2 in the ring
  Number outer = 0;
  End front;
  End rear;
};

/// The part that is common to both units.
template <class Number>
struct Sweep {
  explicit Sweep(const RobotPath& path) : ways(path) {}

  [[nodiscard]] bool holds(Number x, Number y, const SweptBounds<Number>& bounds) const {
    if (around && beyond(x, y) <= bounds.outer) return true;
    if (ways.ahead && on_way(x, y, bounds, bounds.front, bounds.rear)) return true;
    return ways.behind && on_way(-x, y, bounds, bounds.rear, bounds.front);
  }

  /// The bounds of a strip with this half width; the corners are added to it.
  [[nodiscard]] SweptBounds<Number> ring(Number half_width) const {
    const Number twice = twice_radius < 0 ? -twice_radius : twice_radius;
    SweptBounds<Number> bounds;
    bounds.half_width = half_width;
    bounds.outer = bounds.front.outer = bounds.rear.outer = half_width * (half_width + twice);
    const bool has_hole = 2 * half_width < twice;
    bounds.inner = has_hole ? half_width * (half_width - twice) : -(twice * twice / 4);
    return bounds;
  }

  Ways ways;
  bool around = false;      ///< the pivot is in the body, which has corners
  Number twice_radius = 0;  ///< of the way of the robot's origin, positive to the left

 private:
  [[nodiscard]] Number beyond(Number x, Number y) const { return x * x + y * (y - twice_radius); }

  // x counts from the origin towards the end that leads.
  [[nodiscard]] bool on_way(Number x, Number y, const SweptBounds<Number>& bounds,
                            const typename SweptBounds<Number>::End& nose,
                            const typename SweptBounds<Number>::End& tail) const {
    if (x <= -tail.passed) return false;
    if (x <= 0 && y < bounds.middle && y > -bounds.middle) return false;
    if (ways.straight && y <= bounds.half_width && y >= -bounds.half_width) return true;
    if (!ways.arc) return false;
    // Beside the body only the tail comes by; on the inner side it draws away.
    const bool outside = twice_radius > 0 ? y < 0 : y > 0;
    const bool beside = outside && x <= nose.beside;
    if (x <= 0 && !beside) return false;
    const Number square = beyond(x, y);
    return square >= bounds.inner && square <= (beside ? tail.outer : bounds.outer);
  }
};

/// For points of the guard, whole millimetres.
class SweptArea {
 public:
  /// Narrower by `less` on either side (m), but never so narrow that it passes between two points of the guard.
  SweptArea(const RobotPath& path, float less);

  /// True if the place is in the area; for places up to 4 m away.
  [[nodiscard]] bool contains(std::int32_t x, std::int32_t y) const { return sweep_.holds(x, y, bounds_); }
  [[nodiscard]] const Overhang& overhang() const { return overhang_; }

 private:
  Sweep<std::int32_t> sweep_;
  SweptBounds<std::int32_t> bounds_;
  Overhang overhang_;
};

/// For objects: discs, m.
class SweptByBody {
 public:
  SweptByBody() : SweptByBody(RobotPath{}) {}
  explicit SweptByBody(const RobotPath& path);

  [[nodiscard]] bool touches(const recon::Vec2& center, float radius) const;
  /// For several discs of one radius.
  [[nodiscard]] SweptBounds<float> bounds_of(float radius) const;
  /// The same for a point, given the bounds of radius 0.
  [[nodiscard, gnu::noinline]] bool touches(const recon::Vec2& point, const SweptBounds<float>& bounds) const;
  [[nodiscard]] const RobotPath& path() const { return path_; }
  /// m, towards a place.
  [[nodiscard]] float overhang(const recon::Vec2& toward) const {
    return toward.x() > 0 ? overhang_.ahead : overhang_.behind;
  }

 private:
  RobotPath path_;
  Sweep<float> sweep_;
  Corners front_;
  Corners rear_;
  Overhang overhang_;
};

}  // namespace fencepost::alert
