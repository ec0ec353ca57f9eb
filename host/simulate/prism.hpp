// An upright prism as one camera sees it: for a ray, where it runs inside the footprint, fast.
#pragma once

#include <vector>

#include "host/scene/scene.hpp"

namespace fencepost::host {

/// A camera's place: position and the direction of "ahead" in the floor plane, map frame.
struct CameraPose {
  double x = 0;
  double y = 0;
  double z = 0;
  double heading = 0;
};

/// The stretch of a ray over the footprint, distances ahead in metres.
struct Stretch {
  double enter = 0;
  double leave = 0;
};

/// The footprint's edges sorted by the rays that cross them. In the upright camera frame a ray of slope m is (1, -m) s.
/// Along an edge 1/s is linear in m, so a crossing costs one division.
class Prism {
 public:
  Prism(const SceneObject& object, const CameraPose& camera);

  /// Nothing of it lies ahead of the camera.
  [[nodiscard]] bool behind() const { return edges_.empty(); }
  [[nodiscard]] double across_min() const { return across_min_; }
  [[nodiscard]] double across_max() const { return across_max_; }
  /// Heights of its two faces above the camera, m.
  [[nodiscard]] double bottom() const { return bottom_; }
  [[nodiscard]] double top() const { return top_; }
  /// Slopes of rays (rise per metre ahead) that can meet it at all.
  [[nodiscard]] double rise_min() const { return rise_min_; }
  [[nodiscard]] double rise_max() const { return rise_max_; }

  /// An edge of the footprint as the rays `low` <= across < `high` cross it.
  struct Edge {
    double low = 0;
    double high = 0;
    double at_low = 0;  ///< 1/s there
    double slope = 0;
    /// Distance ahead.
    [[nodiscard]] double crossing(double across) const { return 1 / (at_low + slope * (across - low)); }
  };
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }

  /// Stretches of the ray `across`, nearest first. Even-odd, so footprints with holes work too. The first call sorts
  /// the edges; for rays in order, Silhouette needs none of that.
  void stretches(double across, std::vector<Stretch>& out) const;

  /// Distance ahead at which a ray of that rise first meets the solid within `stretch`; negative: it misses.
  [[nodiscard]] double first_hit(const Stretch& stretch, double rise) const;

 private:
  void add_ring(const std::vector<Point>& ring);
  void sort_into_slabs() const;
  void bound_rise();

  double bottom_;  ///< relative to the camera
  double top_;
  double nearest_ = 0;
  double farthest_ = 0;
  double across_min_ = 0;
  double across_max_ = 0;
  double rise_min_ = 0;
  double rise_max_ = 0;
  std::vector<Edge> edges_;
  // Made by the first call of stretches().
  mutable std::vector<double> breaks_;           ///< ascending; slab i is [breaks_[i], breaks_[i+1])
  mutable std::vector<std::size_t> slab_begin_;  ///< into active_, one more than slabs
  mutable std::vector<std::size_t> active_;      ///< indices into edges_
};

}  // namespace fencepost::host
