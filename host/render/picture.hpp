// An image of solids for people: shaded faces on a floor under a wall, far to near.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/metrics/reacquisition.hpp"
#include "host/render/solid.hpp"
#include "host/render/solid_faces.hpp"

namespace fencepost::host {

/// Rows from the top, three bytes (red, green, blue) a pixel.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  [[nodiscard]] sensor::Rgb at(int u, int v) const {
    const auto i = 3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u));
    return {rgb[i], rgb[i + 1], rgb[i + 2]};
  }
};

enum class PictureStyle : unsigned char {
  kShaded,     ///< as a camera would take it
  kSegmented,  ///< each solid in one flat colour on white, as a segmentation shows it
};

/// The target: an image of `camera`, `scale` times enlarged, from `lens`. Without the camera's distortion.
struct PictureView {
  sensor::CameraIntrinsics camera;
  CameraPose lens;
  double pitch = 0;  ///< rad
  int scale = 1;

  [[nodiscard]] Projection projection() const;
  /// From pixels of the camera to pixels of the picture.
  [[nodiscard]] double enlarged(double pixel) const { return (pixel + 0.5) * scale - 0.5; }
};

/// Solids that enclose the lens are left out.
Picture draw_picture(std::span<const Solid> solids, const PictureView& view, PictureStyle style);

/// The outline of a region of the camera's image; dashed ones look broken. Coordinates of `view`'s camera.
void draw_box(Picture& picture, const PictureView& view, const Region& region, sensor::Rgb colour, bool dashed = false);

}  // namespace fencepost::host
