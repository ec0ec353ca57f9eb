// The part of a footprint's perimeter that one image shows: exact, from geometry alone.
#pragma once

#include <cstddef>
#include <vector>

#include "host/metrics/perimeter.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/prism.hpp"

namespace fencepost::host {

/// Slopes of the rays (1, -across, rise) that an image can show, see PixelRays.
struct FieldOfView {
  double across_min = 0;
  double across_max = 0;
  double rise_min = 0;
  double rise_max = 0;
};

/// From border to border of the image, edges of the outermost pixels. With pitch or distortion the image's outline is
/// no upright rectangle of slopes; then the middle row and the middle column count.
FieldOfView field_of_view(const sensor::CameraIntrinsics& camera, double pitch);

/// The visible part of the perimeter of `objects[object]`: it faces the lens and some of its wall is in the image. No
/// other single wall or lid occludes it from top to bottom; joint occlusion by several objects is not considered. Cost:
/// about 1 ms for two circles of 256 vertices.
PerimeterPart visible_perimeter(const std::vector<SceneObject>& objects, std::size_t object, const CameraPose& camera,
                                const FieldOfView& view);

}  // namespace fencepost::host
