// Renders solids to the regions of an image, as a camera would see the reconstruction. Paper sec. III.A: "move the
// camera to it in both the real and rendered worlds".
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "host/metrics/reacquisition.hpp"
#include "host/render/solid.hpp"
#include "host/simulate/optics.hpp"
#include "host/simulate/render.hpp"

namespace fencepost::host {

inline constexpr double kMinRenderedColumns = 3;   ///< px of a solid; one that shows fewer is not rendered
inline constexpr double kMinRenderedShare = 0.15;  ///< of a solid's whole width; one that shows less is not rendered

/// Renders into the images of one camera. Exact: a pixel shows the nearest solid that the ray through its centre meets.
class RegionRenderer {
 public:
  /// The camera's known pitch counts; an unknown one is level.
  explicit RegionRenderer(const sensor::CameraIntrinsics& camera);

  /// For each solid its largest connected region that no nearer solid hides. Nothing if that is too little of it, if
  /// the lens is inside it, or if it has no area. Every solid with an area that does not enclose the lens hides those
  /// behind it. errors: std::length_error for more than 256 solids. Cost: about 0.1 ms a solid that fills a tenth of a
  /// 176x144 image.
  std::vector<std::optional<Region>> render(std::span<const Solid> solids, const CameraPose& lens);

  [[nodiscard]] const sensor::CameraIntrinsics& camera() const { return camera_; }

 private:
  sensor::CameraIntrinsics camera_;
  PixelRays rays_;
  LabelImage image_;
};

/// map_T_lens where the robot stands at `robot`, by the camera's mount.
CameraPose lens_at(const sensor::CameraIntrinsics& camera, const TimedPose& robot);

}  // namespace fencepost::host
