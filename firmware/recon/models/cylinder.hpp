// Alg. 1, our version: centre and radius from edge tangents (paper sec. II.B; the paper takes interval centres).
// A tangent with outward normal n and offset h touches a circle (c, r) when n.c + r = h. That is linear in (c, r) and
// exact at every distance. The bottom row of a box is a third tangent; its normal is the reversed optical axis.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/row_trend.hpp"
#include "firmware/recon/models/tuning.hpp"
#include "firmware/recon/observe/sighting.hpp"
#include "hal/base/fnv1a.hpp"

namespace fencepost::recon {

/// Why there is no cylinder.
enum class CylinderRefusal : std::uint8_t {
  kNone,
  kNoEdges,      ///< nothing but censored ends so far
  kParallax,     ///< all views from nearly one place: the distance is unknown
  kImplausible,  ///< the tangents contradict each other: no positive radius
};

constexpr std::string_view name(CylinderRefusal refusal) {
  switch (refusal) {
    case CylinderRefusal::kNone: return "";
    case CylinderRefusal::kNoEdges: return "only censored ends seen";
    case CylinderRefusal::kParallax: return "parallax too small";
    case CylinderRefusal::kImplausible: return "tangents contradict each other";
  }
  return "";
}

/// A symmetric 3 x 3 matrix over (x, y, r), six numbers.
struct Symmetric3 {
  float xx = 0, xy = 0, yy = 0, xr = 0, yr = 0, rr = 0;

  /// (n, 1) M (n, 1)'
  [[nodiscard]] float along(const Vec2& n) const {
    return n.x() * (n.x() * xx + 2 * (n.y() * xy + xr)) + n.y() * (n.y() * yy + 2 * yr) + rr;
  }
  /// n M n' of the (x, y) part.
  [[nodiscard]] float position_along(const Vec2& n) const {
    return n.x() * (n.x() * xx + 2 * n.y() * xy) + n.y() * n.y() * yy;
  }
  void scale(float factor);
  void add(const Symmetric3& other);
};

/// (x, y, r) with covariance, local frame, metres. Valid only if refusal is kNone.
struct CylinderEstimate {
  Vec2 center{0, 0};
  float radius = 0;
  Symmetric3 covariance;
  CylinderRefusal refusal = CylinderRefusal::kNoEdges;

  [[nodiscard]] bool ok() const { return refusal == CylinderRefusal::kNone; }
  /// Standard deviation of the outline averaged over all directions: sqrt of the mean of (n,1) C (n,1)'.
  [[nodiscard]] float outline_sigma() const;
};

/// Weighted normal equations of n.c + r = h.
struct NormalEquations {
  Symmetric3 information;
  Vec2 moment{0, 0};  ///< of the position
  float moment_radius = 0;

  void add(const Vec2& normal, float bound, float weight);
  void add(const NormalEquations& other);
  /// The same of a line through the centre: it says nothing of the radius.
  void add_through_centre(const Vec2& normal, float bound, float weight);
  /// The same equations for coordinates taken from a point `shift` away: exact, nothing is forgotten.
  void move_origin(const Vec2& shift);
  void scale(float factor);
};

/// The distances at which an object may be while none is known, m.
struct RangeBounds {
  float least = kNearestObject;
  float most = 0;  ///< 0: any
};

/// Incremental robust estimator of one object. Local frame of the object; `lens` below is in it.
class Cylinder {
 public:
  static constexpr std::string_view kName = "cylinder";

  /// Adds the tangents of one view. `novelty` in (0, 1] is the weight of the view (a parked robot learns nothing new).
  void add(const Sighting& sighting, MapPoint origin, float novelty, const MeasurementNoise& noise);

  /// Solves for the current estimate. `lens`: where it was last, for the parallax test; `bearing`: the direction in
  /// which the object was seen from there, unit. It is not behind that.
  void solve(const Vec2& lens, const Vec2& bearing, const MeasurementNoise& noise);

  void move_origin(const Vec2& shift);
  /// Rows come from another calibration from now on: their trend begins anew.
  void recalibrated() { trend_ = {}; }
  void hash(base::Fnv1a64& hash) const;

  [[nodiscard]] const CylinderEstimate& estimate() const { return estimate_; }
  /// The circle of the edges and the configured radius alone: rows lie with a wrong pitch or a foot in the air. `lens`
  /// as in solve().
  [[nodiscard]] CylinderEstimate by_edges(const Vec2& lens) const;
  /// The distances from `lens` in the direction `bearing` (unit) that bearings leave, by kGateSigmas; of edges any.
  [[nodiscard]] RangeBounds range_along(const Vec2& lens, const Vec2& bearing) const;
  /// No end was ever seen: its width is not.
  [[nodiscard]] bool only_bearings() const {
    const Symmetric3& edges = edges_.information;
    return !(edges.rr > 0) && edges.xx + edges.yy > 0;
  }
  [[nodiscard]] float row_count() const { return row_count_; }
  /// The verdict on the object's rows.
  [[nodiscard]] const RowTrend& row_trend() const { return trend_; }
  /// Its rows put it farther than its edges do, by more than kGateSigmas. It approaches by itself, or its foot is above
  /// the floor, or the pitch is wrong: one camera cannot tell which.
  [[nodiscard]] bool rows_beyond_edges() const { return rows_beyond_edges_; }
  /// The same where noise may have feigned the edges' distance.
  [[nodiscard]] bool rows_put_farther() const;
  /// m; 0: not configured.
  [[nodiscard]] float known_radius() const { return known_radius_; }
  [[nodiscard]] std::uint8_t first_views() const { return views_; }
  /// Several views in a row had both ends: not of something longer than the image, of which noise has taken an end.
  [[nodiscard]] bool known_whole() const { return whole_views_ >= kViewsWhole; }

 private:
  void add_edge(const Sighting& sighting, const Ray& ray, const HalfPlane& tangent, float distance, float novelty,
                const MeasurementNoise& noise);
  void add_bearing(const Sighting& sighting, MapPoint origin, float distance, float novelty,
                   const MeasurementNoise& noise);
  /// m, of the estimate, else what is usual.
  [[nodiscard]] float usual_radius() const;
  [[nodiscard]] float shape_variance(const MeasurementNoise& noise) const;
  [[nodiscard]] NormalEquations edges_and_radius() const;
  void scale_edges(float factor);
  [[nodiscard]] CylinderEstimate solve(const Vec2& lens, const MeasurementNoise& noise);
  /// The edges alone know the distance, and not only because noise looks like parallax.
  [[nodiscard]] bool edges_know(const CylinderEstimate& from_edges, const Vec2& lens) const;
  /// The equations of the rows, which count as kIndependentRows at most.
  [[nodiscard]] NormalEquations independent_rows() const;
  /// The line of their trend, which replaces them if it says that they are too far.
  [[nodiscard]] NormalEquations trend_line(const MeasurementNoise& noise) const;

  NormalEquations edges_;
  NormalEquations rows_;
  float row_count_ = 0;
  float known_radius_ = 0;  ///< Sighting::known_radius
  RowTrend trend_;
  float false_depth_ = 0;           ///< information on the distance in edges_ that is only bearing noise, 1/m^2
  std::uint8_t views_ = 0;          ///< counted as far as kFewestViews
  bool seen_whole_ = false;         ///< a view had both ends
  std::uint8_t whole_views_ = 0;    ///< in a row, counted as far as kViewsWhole, and kept then
  bool rows_beyond_edges_ = false;  ///< by the last solve()
  float agreement_ = 1;  ///< running mean of the inlier weights: low when the past does not explain the present
  CylinderEstimate estimate_;
};

/// Distance assumed for an object seen once, from the width of its interval and a known or typical radius. m.
float prior_distance(const Sighting& sighting);

}  // namespace fencepost::recon
