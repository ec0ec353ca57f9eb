// One blob seen from one known pose: the only input that the models take.
#pragma once

#include <cstdint>

#include "firmware/recon/geometry.hpp"
#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/observation.hpp"
#include "firmware/recon/observe/pose_history.hpp"
#include "firmware/recon/observe/tuning.hpp"

namespace fencepost::recon {

/// The noise of edges and poses. It is better over-estimated than under-estimated: measured, twice too large costs
/// nothing, twice too small does.
struct MeasurementNoise {
  float edge_px = kEdgeNoise;       ///< px, sigma of one box edge
  float heading = kHeadingNoise;    ///< rad, sigma of the pose's heading at one exposure
  float position = kPositionNoise;  ///< m, sigma of the pose's position at one exposure
  float row_px = kRowNoise;         ///< px, sigma of a box's bottom row
  float pitch = kPitchNoise;        ///< rad, uncertainty of the camera's pitch: the same in every view
  float roundness = kRoundness;     ///< share of the radius by which real footprints differ from a circle
};

/// A ray from the lens to one end.
struct Ray {
  Vec2 direction{1, 0};  ///< unit, map axes
  End end = End::kLowerBound;
};

/// How far the ray to a box's top or bottom falls below the horizontal for each metre of forward depth.
struct RowSlope {
  float drop = 0;  ///< m/m
  End end = End::kLowerBound;
};

/// A view of one blob. Directions in map axes; the lens is at `anchor` + `lens` (m).
struct Sighting {
  MapPoint anchor;    ///< the robot's position at the exposure
  Vec2 lens{0, 0};    ///< lens relative to the anchor, m, map axes
  Vec2 axis{1, 0};    ///< optical axis on the ground, unit
  Vec2 center{1, 0};  ///< bearing of the interval's centre, unit
  Ray left;
  Ray right;
  RowSlope top;
  RowSlope bottom;
  float focal = 1;           ///< px, for the edge noise
  float lens_height = 0;     ///< m
  float known_radius = 0;    ///< m, of a circle as wide as all things of this colour are known to be; 0: not known
  bool bearing = false;      ///< of the object's middle alone, by `center`
  bool equidistant = false;  ///< a column is the same angle everywhere
  bool cut_at_side = false;  ///< the image's left or right border cuts the blob
  bool rows_known = false;   ///< the camera's pitch and height are known: the bottom row gives a depth

  /// The lens in a local frame with map axes.
  [[nodiscard]] Vec2 lens_from(MapPoint origin) const { return offset_from(origin, anchor) + lens; }
  /// Neither end is the object's own.
  [[nodiscard]] bool no_edge() const { return !is_edge(left.end) && !is_edge(right.end); }
  [[nodiscard]] bool both_edges() const { return is_edge(left.end) && is_edge(right.end); }
};

/// map_T_lens at one exposure.
struct LensPose {
  MapPoint anchor;
  Vec2 lens{0, 0};
  Vec2 axis{1, 0};  ///< also the rotation (cosine, sine) from the level camera frame to map axes

  /// The lens in a local frame with map axes.
  [[nodiscard]] Vec2 lens_from(MapPoint origin) const { return offset_from(origin, anchor) + lens; }
};

/// A vector of map axes in those of the level camera (x along the optical axis, y to the left), and back.
inline Vec2 to_camera(const LensPose& pose, const Vec2& in_map) {
  return {pose.axis.dot(in_map), cross(pose.axis, in_map)};
}
inline Vec2 to_map(const LensPose& pose, const Vec2& in_camera) { return rotated(pose.axis, in_camera); }

LensPose lens_pose(const MapPose& robot, const CameraModel& camera);

/// The rays are computed here and not for all blobs of a frame, for models use the sightings of a few objects a frame.
/// On a core without floating point each costs some thousand instructions.
Sighting make_sighting(const CameraModel& camera, const LensPose& pose, const Observation& observation);

/// The tangent half planes of the two edges: the object lies inside both. Left edge: normal = direction turned left,
/// right edge: turned right. Local frame at `origin`.
HalfPlane left_tangent(const Sighting& sighting, MapPoint origin);
HalfPlane right_tangent(const Sighting& sighting, MapPoint origin);

/// Variance (rad^2) of the direction of the ray to an edge.
float direction_variance(const Sighting& sighting, const Ray& ray, const MeasurementNoise& noise);

/// Variance (rad^2) of the direction `center` of a bearing: that of one edge.
inline float bearing_variance(const Sighting& sighting, const MeasurementNoise& noise) {
  return direction_variance(sighting, {sighting.center, End::kSeen}, noise);
}

/// Variance (m^2) of a tangent's offset at distance `distance` from the lens, non-roundness left out, by that of its
/// direction.
float edge_variance(float direction, float distance, const MeasurementNoise& noise);
inline float edge_variance(const Sighting& sighting, const Ray& ray, float distance, const MeasurementNoise& noise) {
  return edge_variance(direction_variance(sighting, ray, noise), distance, noise);
}

/// Depth along the axis (m) of the nearest point of an object that stands on the floor, from its bottom row.
struct RowDepth {
  bool known = false;
  float depth = 0;     ///< m
  float variance = 0;  ///< m^2, noise of this row alone and pitch together
};

/// The depth of a foot that is *not* seen: it is lower, so the object is nearer than the row where it disappears.
/// Returns the middle of the remaining range, with a sigma that covers it. Known only if the bottom is censored.
RowDepth hidden_row_depth(const Sighting& sighting);

/// The maximum depth of an unseen foot: it is no farther than where it disappears. Not known if the foot is seen, or if
/// the row is another object's.
RowDepth farthest_row_depth(const Sighting& sighting, const MeasurementNoise& noise);

/// The depth by the bottom row. Not known if the camera's height or pitch is not, or if the row is censored or above
/// the horizon. Nor is it known if both edges are censored, or beyond kRowMaxDepth.
RowDepth row_depth(const Sighting& sighting, const MeasurementNoise& noise);

}  // namespace fencepost::recon
