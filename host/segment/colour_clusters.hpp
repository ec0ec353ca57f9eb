// Which colours a set of images has: the colours of smoothed images fall into clusters.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "host/segment/appearance.hpp"

namespace fencepost::host {

/// Mean-shift filtering (Comaniciu and Meer 2002, as in the paper's Edison). Each pixel moves to the mode of its
/// neighbourhood of `spatial` px and `range` grey levels. 8-bit blue, green, red.
cv::Mat mean_shift(const cv::Mat& image, double spatial, double range);

/// How often one image shows a colour (steps of 8 grey levels).
struct ColourCount {
  cv::Vec3d bgr;  ///< mean
  double pixels = 0;
  double border_pixels = 0;  ///< of them on the image's border
  std::size_t image = 0;
};

/// Counts the pixels whose neighbours all look alike, in order of colour: the mixtures along edges are none of the
/// scene's colours. Pixels darker than `darkest` in every channel are left out.
std::vector<ColourCount> count_colours(const cv::Mat& smooth, int darkest, std::size_t image);

struct ColourCluster {
  Appearance looks;
  sensor::Rgb rgb;
  double pixels = 0;
  double border_pixels = 0;
  std::size_t images = 0;  ///< that show at least min_pixels of it
};

/// Clusters of radius kSameColour about, most pixels first. Same counts, same clusters.
std::vector<ColourCluster> cluster_colours(std::vector<ColourCount> counts, double min_pixels);

}  // namespace fencepost::host
