// An object as the robot's camera would see it from a pose: a model rendered into the image, for the tracker.
#pragma once

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/models/cylinder.hpp"
#include "firmware/recon/models/hybrid/hybrid.hpp"
#include "firmware/recon/observe/sighting.hpp"

namespace fencepost::recon {

/// The point where a line of sight touches an object, from the lens in camera axes, m. x is along the optical axis, y
/// to the left. `variance`: across the line of sight, m^2.
struct TouchPoint {
  Vec2 at{1, 0};
  float variance = 0;
};

struct Silhouette {
  TouchPoint left;
  TouchPoint right;
  float depth = 0;  ///< m along the axis to its nearest point
};

/// Directions with less than this forward share are not in any image.
inline constexpr float kSideways = 0.05F;

/// The tangents of a circle. `lens` is in the frame of the estimate; `others` is the variance (m^2) of what its
/// covariance leaves out: shape and pose. False, and `seen` is as before: the lens is inside it, or it is behind.
bool render(const CylinderEstimate& cylinder, const Vec2& lens, const LensPose& pose, float others, Silhouette& seen);

/// The outermost corners of an outline. `lens` is in its local frame. False, and `seen` is as before: the lens is
/// inside it or more than 6 m away, or it is behind.
bool render(const OutlineView& outline, const Vec2& lens, const LensPose& pose, float others, Silhouette& seen);

}  // namespace fencepost::recon
