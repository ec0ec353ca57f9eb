// The next best view of an object: the arc whose views would add most to its outline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/models/hybrid/hybrid.hpp"

namespace fencepost::recon {

/// A disc that the robot must not enter. Metres, local frame of the outline.
struct Disc {
  Vec2 center{0, 0};
  float radius = 0;
};

enum class NextViewRefusal : std::uint8_t {
  kNone,
  kNoOutline,  ///< there is no outline yet: any view that moves sideways helps
  kBlocked,    ///< each place from where it could be seen is occupied
};

/// Directions are those of the camera as seen from the object, map axes.
struct NextView {
  NextViewRefusal refusal = NextViewRefusal::kNoOutline;
  Vec2 toward{1, 0};  ///< unit, to the middle of the arc
  Vec2 place{0, 0};   ///< on it, m, local frame of the outline
  float width = 0;    ///< of the arc, rad
  float gain = 0;     ///< share of the outline's area that a view from there may change

  [[nodiscard]] bool ok() const { return refusal == NextViewRefusal::kNone; }
};

/// Finds the view with the greatest expected gain: the paper's novelty (section III.B), predicted. A view adds two
/// tangents, whose normals lie some 85 degrees to either side of it. A tangent may cut off the corner between its two
/// neighbours. That is much between distant tangents with long sides, and little where they meet in a corner of the
/// object. Where a side was seen once, a second view adds a little. The arc holds the views with most of the greatest
/// gain; nearer places count a little more.
/// `robot` and `others`: in the outline's local frame. The place is at the robot's present distance, but within
/// kNearestView and kFarthestView, and not within `clearance` of the others. Obstacles on the way and occlusion from
/// there are not checked.
NextView next_view(const OutlineView& outline, ConstClusters clusters, const Vec2& robot, std::span<const Disc> others,
                   float clearance);

inline constexpr float kNearestView = 0.4F;   ///< m. By design: nearer, a block fills the image
inline constexpr float kFarthestView = 1.0F;  ///< m. By design: farther, an edge is known to a centimetre only

}  // namespace fencepost::recon
