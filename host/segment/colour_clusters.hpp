// Which colours a set of images has: mean-shift smoothed images fall into regions, their colours into clusters.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "host/segment/appearance.hpp"

namespace fencepost::host {

/// Mean-shift filtering (Comaniciu and Meer 2002, as in the paper's Edison): each pixel moves to the mode of its
/// neighbourhood of `spatial` px and `range` grey levels. 8-bit blue, green, red.
cv::Mat mean_shift(const cv::Mat& image, double spatial, double range);

/// One region of nearly constant colour in a smoothed image.
struct ColourRegion {
  cv::Vec3d bgr;  ///< mean
  double pixels = 0;
  double border_pixels = 0;  ///< of them on the image's border
  std::size_t image = 0;
};

/// Regions of at least `min_pixels`. Pixels darker than `darkest` in every channel belong to none. Edges between
/// colours are too thin to be one.
std::vector<ColourRegion> colour_regions(const cv::Mat& smooth, double min_pixels, int darkest, std::size_t image);

struct ColourCluster {
  Appearance looks;
  sensor::Rgb rgb;
  double pixels = 0;
  double border_pixels = 0;
  std::size_t images = 0;  ///< that have a region of it
};

/// Clusters of radius kSameColour about, largest first. Same regions, same clusters.
std::vector<ColourCluster> cluster_colours(std::vector<ColourRegion> regions);

}  // namespace fencepost::host
