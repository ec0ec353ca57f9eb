// Alg. 3 (paper sec. II.D) without the cuts that the hybrid's evidence contradicts. One wrong wedge, or a hundred noisy
// ones, carve all away, and carved cells never come back. So the tangents are kept, and carved with on request. The
// paper's form is recon::Carving.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "host/models/carve.hpp"

namespace fencepost::host {

/// Keeps the edges of all sightings that an object's models took; for the desk.
class KeptTangents {
 public:
  static constexpr std::string_view kName = "kept_tangents";
  /// 800 KB an object at most: half an hour at 18 frames/s. Then the older half goes: forgetting a cut is always safe.
  static constexpr std::size_t kMax = 1U << 16U;

  void start(const recon::Sighting& /*first*/, recon::MapPoint /*origin*/) { tangents_.clear(); }
  void add(const recon::ModelView& view) {
    if (recon::is_edge(view.sighting.left.end)) keep(recon::left_tangent(view.sighting, view.origin));
    if (recon::is_edge(view.sighting.right.end)) keep(recon::right_tangent(view.sighting, view.origin));
  }
  void move_origin(const recon::Vec2& shift) {
    for (recon::HalfPlane& tangent : tangents_) tangent = recon::seen_from(tangent, shift);
  }
  void shift(const recon::Vec2& /*step*/) {}

  /// Local frame of the object.
  [[nodiscard]] std::span<const recon::HalfPlane> tangents() const { return tangents_; }

 private:
  void keep(const recon::HalfPlane& tangent) {
    if (tangents_.size() == kMax) tangents_.erase(tangents_.begin(), tangents_.begin() + kMax / 2);
    tangents_.push_back(tangent);
  }

  std::vector<recon::HalfPlane> tangents_;
};

/// Threshold in sigmas of the hybrid's outline. A tangent is contradicted if the piece that it cuts off is thicker
/// there. More: noise eats the object; less: corners stay. quality_table, seeds 5001 to 5016.
inline constexpr float kContradictedSigmas = 2.0F;

/// The outline of one hybrid, to be asked about tangents.
class Evidence {
 public:
  /// `origin`: of the object's local frame.
  Evidence(const recon::HybridCore& hybrid, const recon::OutlineView& outline, recon::MapPoint origin);
  /// False as long as there is no outline.
  [[nodiscard]] bool contradicts(const recon::HalfPlane& tangent) const;

 private:
  bool known_;
  recon::OutlineView outline_;
  recon::Vec2 middle_{0, 0};  ///< the hybrid's origin in the object's frame
};

/// As much room as on profile `full`.
struct Carved {
  static constexpr std::size_t kCells = 128;  ///< along a side of the grid
  recon::ConvexClip<192> clip;
  recon::CarveGrid<kCells> grid;
};

/// Carves with the tangents that `evidence` does not contradict, in their order.
Carved carve_with(std::span<const recon::HalfPlane> tangents, const Evidence& evidence);

}  // namespace fencepost::host
