// Alg. 3 as one model (paper sec. II.D): the grid of cells, and the exact polygon of the same wedges. The grid is
// placed anew around the polygon, with finer cells.
#pragma once

#include <cstddef>
#include <string_view>

#include "firmware/recon/models/clip.hpp"
#include "firmware/recon/models/model_view.hpp"
#include "hal/base/fixed.hpp"
#include "host/models/carve.hpp"

namespace fencepost::recon {

/// kCells: of the grid's side; kVertices: of the polygon, 8 bytes each; kPending: tangents kept until the object has a
/// place, 12 bytes each.
template <std::size_t kCells, std::size_t kVertices, std::size_t kPending>
class Carving {
 public:
  static constexpr std::string_view kName = "carving";

  /// Around a guessed place until there is an estimate: the first wedges can be carved before any distance is known.
  void start(const Sighting& /*first*/, MapPoint /*origin*/) {
    pending_.clear();
    placed_ = false;
    clip_.start();
    grid_.start();
  }

  void add(const ModelView& view) {
    if (is_edge(view.sighting.left.end)) cut(left_tangent(view.sighting, view.origin));
    if (is_edge(view.sighting.right.end)) cut(right_tangent(view.sighting, view.origin));
    grid_.refine(clip_.vertices());
  }

  /// The world is solid again around the new origin, but for the tangents that waited for it.
  void move_origin(const Vec2& shift) {
    clip_.start();
    grid_.start();
    placed_ = true;
    for (const HalfPlane& tangent : pending_) cut(seen_from(tangent, shift));
    pending_.clear();
  }
  void shift(const Vec2& /*step*/) {}

  [[nodiscard]] const ConvexClip<kVertices>& clip() const { return clip_; }
  [[nodiscard]] const CarveGrid<kCells>& grid() const { return grid_; }

 private:
  void cut(const HalfPlane& tangent) {
    clip_.cut(tangent);
    grid_.carve(tangent);
    if (placed_) return;
    if (pending_.full()) pending_.erase_at(0);  // the oldest, farthest one: forgetting a cut is always safe
    static_cast<void>(pending_.push_back(tangent));
  }

  base::FixedVector<HalfPlane, kPending> pending_;  ///< tangents seen while the place was a guess
  bool placed_ = false;
  ConvexClip<kVertices> clip_;
  CarveGrid<kCells> grid_;
};

}  // namespace fencepost::recon
