// The height band of an object, from the rows of its boxes and its place.
#pragma once

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

struct HeightRange {
  bool bottom_known = false;
  bool top_known = false;
  float z_min = 0;  ///< m above the floor
  float z_max = 0;
};

/// z = lens height - drop * depth, with depth = (c - P).axis - r of each view. It is linear in (c, r), so sums suffice
/// without the views, and they follow the centre as it improves. An unknown pitch counts as zero.
class HeightBand {
 public:
  void add(const Sighting& sighting, MapPoint origin);
  void move_origin(const Vec2& shift);
  void hash(base::Fnv1a64& hash) const;
  [[nodiscard]] HeightRange at(const Vec2& center, float radius) const;

  struct Sums {
    Vec2 slope{0, 0};  ///< sum of drop * axis
    float start = 0;   ///< sum of drop * (P.axis)
    float drop = 0;    ///< sum of drop
    float height = 0;  ///< sum of lens heights
    float views = 0;
  };
  [[nodiscard]] const Sums& bottom() const { return bottom_; }
  [[nodiscard]] const Sums& top() const { return top_; }

 private:
  Sums bottom_;
  Sums top_;
};

}  // namespace fencepost::recon
