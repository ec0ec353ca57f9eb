// Compares how fast the rows of an object's foot come nearer with how fast the robot does. A foot on the floor agrees.
// A base, a hidden foot, a lens configured too long or too high, or a wrong pitch give a wrong depth. It then shrinks
// too fast or too slowly. A line fitted to it over the robot's way reaches zero at the object's true place.
#pragma once

#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

/// The verdict of the line fitted to the depths.
enum class RowVerdict : std::uint8_t {
  kUnknown,  ///< the robot has not come near enough, or the estimate is still too uncertain
  kTrue,     ///< they shrink as they should
  kTooFar,   ///< the object is nearer than its rows say
  kTooNear,  ///< it is farther
};

/// One object's. Local frame of the object.
class RowTrend {
 public:
  /// `bearing`: towards the object, unit; `range`: along it, m, by the row; `weight`: 1 / m^2.
  void add(const Vec2& lens, const Vec2& bearing, float range, float weight);
  void move_origin(const Vec2& shift) { lens_ -= shift; }

  /// Judges anew.
  void judge();
  [[nodiscard]] RowVerdict verdict() const { return verdict_; }
  /// The true depth as a share of what the rows say; 1 as long as nothing is known.
  [[nodiscard]] float scale() const { return scale_; }
  /// The factor that shortens the depth by the rows, at most 1: no obstacle is reported farther than its rows say.
  [[nodiscard]] float nearer() const { return verdict_ == RowVerdict::kTooFar ? scale_ : 1.0F; }

  /// The line that the object does not cross towards the latest lens, and the variance (m^2) of its offset. Needs a
  /// verdict.
  struct Front {
    HalfPlane plane;
    float variance = 0;
  };
  [[nodiscard]] Front front() const;

  void hash(base::Fnv1a64& hash) const;

 private:
  [[nodiscard]] float spread() const { return travel_square_ - travel_ * travel_ / weight_; }

  // Weighted sums over the robot's way towards the object and the ranges by its rows.
  float weight_ = 0;
  float travel_ = 0;
  float travel_square_ = 0;
  float range_ = 0;
  float travel_range_ = 0;
  float travelled_ = 0;  ///< at the latest sighting
  Vec2 lens_{0, 0};      ///< of that
  Vec2 bearing_{1, 0};
  Vec2 first_bearing_{1, 0};
  float scale_ = 1;
  RowVerdict verdict_ = RowVerdict::kUnknown;
};

}  // namespace fencepost::recon
