// Alg. 1 as the paper has it (sec. II.B): least-squares intersection of the bearings of interval centres; radius from
// the mean angular half width. Every view with two true ends counts the same; nothing is refused but parallel rays.
#pragma once

#include <string_view>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

struct PaperCylinder {
  bool ok = false;
  Vec2 center{0, 0};  ///< local frame, m
  float radius = 0;   ///< m
};

/// r = mean of d sin(half angle), d taken along each bearing, so that the sum needs no memory of the views.
class CylinderPaper {
 public:
  static constexpr std::string_view kName = "cylinder_paper";

  void start(const Sighting& /*first*/, MapPoint /*origin*/) { *this = {}; }
  void add(const ModelView& view) { add(view.sighting, view.origin); }
  void add(const Sighting& sighting, MapPoint origin);
  void shift(const Vec2& /*step*/) {}
  void move_origin(const Vec2& shift);
  [[nodiscard]] PaperCylinder solve() const;
  /// Views with two true ends so far, as a float.
  [[nodiscard]] float views() const { return sums_.views; }

 private:
  struct Sums {
    float nxx = 0, nxy = 0, nyy = 0;  ///< sum of n n', n normal to the bearing
    Vec2 moment{0, 0};                ///< sum of n (n.P)
    Vec2 reach{0, 0};                 ///< sum of d sin(half), d the bearing
    float start = 0;                  ///< sum of (P.d) sin(half)
    float views = 0;
  };
  Sums sums_;
};

}  // namespace fencepost::recon
