// Predicts how a camera at a pose sees an object: edges and rows, px. Templates over the number type, for derivatives.
#pragma once

#include <cmath>

#include "host/calibrate/lens_model.hpp"
#include "host/calibrate/problem.hpp"

namespace fencepost::host::calibration {

template <class T>
struct Pose {
  T x;
  T y;
  T heading;
};

/// The reported motion from one time to another, in the frame of the pose at the first.
template <class T>
struct Motion {
  T ahead;
  T left;
  T turn;
  T way;
};

inline Motion<double> motion_between(const TrackPose& a, const TrackPose& b) {
  const double c = std::cos(a.heading);
  const double s = std::sin(a.heading);
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return {c * dx + s * dy, c * dy - s * dx, b.heading - a.heading, b.way - a.way};
}

/// The true motion, by the wheels' true numbers: over a short motion the heading's error grows evenly.
template <class T>
Motion<T> corrected(const Motion<T>& reported, const T* wheels) {
  using std::cos;
  using std::sin;
  const T error = wheels[kTurn] * reported.turn + wheels[kCurve] * reported.way;
  const T scale = 1.0 + wheels[kStep];
  const T c = cos(0.5 * error) * scale;
  const T s = sin(0.5 * error) * scale;
  return {c * reported.ahead - s * reported.left, s * reported.ahead + c * reported.left, reported.turn + error,
          scale * reported.way};
}

template <class T>
Pose<T> after(const T* node, const Motion<T>& motion) {
  using std::cos;
  using std::sin;
  const T c = cos(node[kPoseHeading]);
  const T s = sin(node[kPoseHeading]);
  return {node[kPoseX] + c * motion.ahead - s * motion.left, node[kPoseY] + s * motion.ahead + c * motion.left,
          node[kPoseHeading] + motion.turn};
}

/// The robot at the exposure of a frame that arrived at `t`.
template <class T>
Pose<T> pose_at_exposure(const OdometryTrack& odometry, double node_time, double t, const T& latency, const T* wheels,
                         const T* node) {
  const double exposure = t - value_of(latency);
  const TrackPose start = odometry.at(node_time);
  const Motion<double> moved = motion_between(start, odometry.at(exposure));
  const TrackPose rate = odometry.rate(exposure);
  const Motion<double> moving = motion_between({0, 0, start.heading, 0}, {rate.x, rate.y, start.heading, rate.way});
  const T earlier = latency - value_of(latency);  // zero, with a derivative
  const Motion<T> reported{moved.ahead - moving.ahead * earlier, moved.left - moving.left * earlier,
                           moved.turn - rate.heading * earlier, moved.way - moving.way * earlier};
  return after(node, corrected(reported, wheels));
}

/// The camera over the floor: where it is, where it looks, how it maps.
template <class T>
struct View {
  T x;
  T y;
  T azimuth;
  T ahead_x;  ///< unit vector of the azimuth
  T ahead_y;
  T fx;
  T fy;
  T sin_pitch;
  T cos_pitch;
};

template <class T>
View<T> view_of(const ConfiguredOptics& optics, const T* camera, const Pose<T>& robot) {
  using std::cos;
  using std::exp;
  using std::sin;
  const T c = cos(robot.heading);
  const T s = sin(robot.heading);
  const T azimuth = robot.heading + camera[kYaw];
  const T scale = exp(camera[kFocal]);
  return {robot.x + c * camera[kMountX] - s * camera[kMountY],
          robot.y + s * camera[kMountX] + c * camera[kMountY],
          azimuth,
          cos(azimuth),
          sin(azimuth),
          optics.fx * scale,
          optics.fy * scale,
          sin(camera[kPitch]),
          cos(camera[kPitch])};
}

/// How far the footprint reaches in the direction (nx, ny), a unit vector, from the origin of the map.
template <class T>
T support(const T* object, const T& nx, const T& ny) {
  T reach = nx * object[kCentreX] + ny * object[kCentreY] + object[kRadius];
  T c = nx;
  T s = ny;
  for (std::size_t m = 2; m <= kLastHarmonic; ++m) {
    const T next = c * nx - s * ny;  // cos((m) phi) from cos((m - 1) phi)
    s = s * nx + c * ny;
    c = next;
    const std::size_t at = kShape + 2 * (m - 2);
    reach += c * object[at] + s * object[at + 1];
  }
  return reach;
}

/// How fast that grows as the direction turns to the left: the point that touches lies so far along (-ny, nx) from the
/// middle.
template <class T>
T support_slope(const T* object, const T& nx, const T& ny) {
  T slope = T(0.0);
  T c = nx;
  T s = ny;
  for (std::size_t m = 2; m <= kLastHarmonic; ++m) {
    const T next = c * nx - s * ny;
    s = s * nx + c * ny;
    c = next;
    const std::size_t at = kShape + 2 * (m - 2);
    slope += static_cast<double>(m) * (c * object[at + 1] - s * object[at]);
  }
  return slope;
}

/// The row, over the focal length, of a point `depth` ahead over the floor and `drop` below the lens.
template <class T>
T row_of(const View<T>& view, const T& depth, const T& drop) {
  return (drop * view.cos_pitch - depth * view.sin_pitch) / (depth * view.cos_pitch + drop * view.sin_pitch);
}

constexpr double kNearest = 0.02;  ///< m: nothing is nearer to the lens, whatever a step of the solver tries

template <class T>
T not_behind(const T& depth) {
  return value_of(depth) < kNearest ? T(kNearest) : depth;
}

/// The column of one edge of an object. `seen` is the measured one: the tangent is looked for beside it.
/// `sign`: +1 the left edge, -1 the right one.
template <class T>
T edge_column(const ConfiguredOptics& optics, const T* camera, const View<T>& view, const T* object,
              const Sighting& sighting, double seen, double sign) {
  const double row = row_of_edge(optics, value_of(view.fy) * value_of(camera[kPitch]), sighting, seen, sign);
  const T across =
      undistorted_column<T>(optics, camera[kK1], (optics.cx - seen) / view.fx, (row - optics.cy) / view.fy);

  // On a level `drop` below a pitched lens a column is a line from a point that lies drop * tan(pitch) behind it.
  const T slope = across * view.cos_pitch;
  const T length = sqrt(1.0 + slope * slope);
  const T along_x = (view.ahead_x - slope * view.ahead_y) / length;
  const T along_y = (view.ahead_y + slope * view.ahead_x) / length;
  const T nx = -sign * along_y;
  const T ny = sign * along_x;
  const T beyond = support(object, nx, ny) - nx * view.x - ny * view.y;
  // Range of the point that touches, not of the middle: a residual that a shape can make smaller by a factor bends the
  // shape.
  const T range = not_behind<T>(along_x * (object[kCentreX] - view.x) + along_y * (object[kCentreY] - view.y) -
                                sign * support_slope(object, nx, ny));
  const T depth = range / length;
  const T tan_pitch = view.sin_pitch / view.cos_pitch;

  const auto column_at = [&](const T& drop) {
    // The normal leans against the axis by the slope.
    const T miss = beyond - sign * (slope / length) * drop * tan_pitch;
    const T turn = sign * miss / range;
    const T found = (slope + turn) / (1.0 - slope * turn) / view.cos_pitch;
    const T down = row_of(view, depth, drop);
    return optics.cx - view.fx * found * distortion<T>(optics, camera[kK1], found, down);
  };
  const T bottom = column_at(camera[kHeight]);
  const T top = column_at(camera[kHeight] - object[kTop]);
  T outermost = (sign > 0) == (value_of(bottom) < value_of(top)) ? bottom : top;
  // A bent edge may reach farthest where it crosses the horizontal through the principal point.
  const T level = depth * tan_pitch;
  if (value_of(level) < value_of(camera[kHeight]) && value_of(level) > value_of(camera[kHeight] - object[kTop])) {
    const T middle = column_at(level);
    if ((sign > 0) == (value_of(middle) < value_of(outermost))) outermost = middle;
  }
  if (!optics.equidistant) return outermost;
  // A bow that is bent by pitch and lens together has its end anywhere: beside it a step is of second order.
  constexpr int kSteps = 6;
  for (int i = 1; i < kSteps; ++i) {
    const T between = column_at(camera[kHeight] - object[kTop] * (static_cast<double>(i) / kSteps));
    if ((sign > 0) == (value_of(between) < value_of(outermost))) outermost = between;
  }
  return outermost;
}

/// The row of a point on the floor plan that lies `drop` below the lens.
template <class T>
T row_of_point(const ConfiguredOptics& optics, const T* camera, const View<T>& view, const T& x, const T& y,
               const T& drop) {
  const T dx = x - view.x;
  const T dy = y - view.y;
  const T depth = not_behind<T>(dx * view.ahead_x + dy * view.ahead_y);
  const T across = (dy * view.ahead_x - dx * view.ahead_y) / (depth * view.cos_pitch + drop * view.sin_pitch);
  const T down = row_of(view, depth, drop);
  return optics.cy + view.fy * down * distortion<T>(optics, camera[kK1], across, down);
}

/// Where on the rim the row is extreme: the outward normal there.
struct RimNormal {
  double x;
  double y;
};
inline RimNormal extreme_of_rim(const ConfiguredOptics& optics, const CameraValues& camera, const View<double>& view,
                                const ObjectValues& object, double drop, double sign) {
  double x = object[kCentreX];
  double y = object[kCentreY];
  RimNormal n{};
  // The rows' gradient turns little from one side of an object to the other: twice is enough.
  for (int i = 0; i < 3; ++i) {
    constexpr double kStep = 1e-4;  // m
    const auto row = [&](double dx, double dy) {
      return sign * row_of_point<double>(optics, camera.data(), view, x + dx, y + dy, drop);
    };
    n = {row(kStep, 0) - row(-kStep, 0), row(0, kStep) - row(0, -kStep)};
    const double length = std::hypot(n.x, n.y);
    if (length < 1e-12) return {-view.ahead_x, -view.ahead_y};
    n = {n.x / length, n.y / length};
    const double reach = support(object.data(), n.x, n.y) - n.x * object[kCentreX] - n.y * object[kCentreY];
    const double slope = support_slope(object.data(), n.x, n.y);
    x = object[kCentreX] + reach * n.x - slope * n.y;
    y = object[kCentreY] + reach * n.y + slope * n.x;
  }
  return n;
}

/// The lowest (`sign` +1) or the highest (-1) row of the object's rim at a level `drop` below the lens. Through a lens
/// that bends it is not that of the point nearest along the axis.
template <class T>
T rim_row(const ConfiguredOptics& optics, const T* camera, const View<T>& view, const T* object, const T& drop,
          double sign) {
  CameraValues camera_values{};
  ObjectValues values{};
  for (std::size_t i = 0; i < kCameraParameters; ++i) camera_values[i] = value_of(camera[i]);
  for (std::size_t i = 0; i < kObjectParameters; ++i) values[i] = value_of(object[i]);
  const View<double> seen = {value_of(view.x),       value_of(view.y),         value_of(view.azimuth),
                             value_of(view.ahead_x), value_of(view.ahead_y),   value_of(view.fx),
                             value_of(view.fy),      value_of(view.sin_pitch), value_of(view.cos_pitch)};
  const RimNormal n = extreme_of_rim(optics, camera_values, seen, values, value_of(drop), sign);
  // At the extreme a turn of the normal changes nothing: its derivative is left out.
  const T nx = T(n.x);
  const T ny = T(n.y);
  const T reach = support(object, nx, ny) - nx * object[kCentreX] - ny * object[kCentreY];
  const T slope = support_slope(object, nx, ny);
  return row_of_point<T>(optics, camera, view, object[kCentreX] + reach * nx - slope * ny,
                         object[kCentreY] + reach * ny + slope * nx, drop);
}

template <class T>
T row_in_image(const ConfiguredOptics& optics, const T* camera, const View<T>& view, double column, const T& depth,
               const T& drop) {
  const T down = row_of(view, not_behind(depth), drop);
  const T across = (optics.cx - column) / view.fx;
  return optics.cy + view.fy * down * distortion<T>(optics, camera[kK1], across, down);
}

template <class T>
T nearest_depth(const View<T>& view, const T* object) {
  return -support<T>(object, -view.ahead_x, -view.ahead_y) - view.ahead_x * view.x - view.ahead_y * view.y;
}

/// Straight lines of the floor are bows in the image.
template <class T>
bool bends(const ConfiguredOptics& optics, const T* camera) {
  return optics.equidistant || value_of(camera[kK1]) != 0;
}

/// The row of the foot: of the footprint's nearest point.
template <class T>
T foot_row(const ConfiguredOptics& optics, const T* camera, const View<T>& view, const T* object, double column) {
  if (bends(optics, camera)) return rim_row<T>(optics, camera, view, object, camera[kHeight], 1);
  return row_in_image<T>(optics, camera, view, column, nearest_depth(view, object), camera[kHeight]);
}

/// The row of the top: of its far rim where the lens looks down on it, else of its near one.
template <class T>
T top_row(const ConfiguredOptics& optics, const T* camera, const View<T>& view, const T* object, double column) {
  const T drop = camera[kHeight] - object[kTop];
  if (bends(optics, camera)) return rim_row<T>(optics, camera, view, object, drop, -1);
  if (value_of(drop) < 0) return row_in_image<T>(optics, camera, view, column, nearest_depth(view, object), drop);
  const T far = support<T>(object, view.ahead_x, view.ahead_y) - view.ahead_x * view.x - view.ahead_y * view.y;
  return row_in_image<T>(optics, camera, view, column, far, drop);
}

}  // namespace fencepost::host::calibration
