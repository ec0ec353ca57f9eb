// Connected regions of one signature: what a colour camera would have called blobs.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::host {

struct RegionRules {
  int min_pixels = 12;  ///< smaller ones are noise
  /// px. Regions of one signature with a gap of at most this in both directions are one, unless another signature fills
  /// the gap.
  int max_gap = 2;
  /// px. An end this near to the image's border is put onto it: there a smoothed image does not show whether the object
  /// goes on outside.
  int border = 2;
};

/// Bounds inclusive, whole pixels.
struct ImageRegion {
  std::uint8_t label = 0;
  int x1 = 0;
  int y1 = 0;
  int x2 = 0;
  int y2 = 0;
  std::uint32_t pixels = 0;
  double sum_u = 0;
  double sum_v = 0;
  cv::Vec3d sum_bgr{0, 0, 0};
};

struct Regions {
  std::vector<ImageRegion> kept;  ///< largest first
  std::size_t small = 0;          ///< dropped: fewer than min_pixels
  std::size_t merged = 0;         ///< joined across a gap to another
};

/// `labels`: 0 is background, one byte a pixel; `image`: the colours as they were, blue, green, red. Diagonal
/// neighbours are connected.
Regions find_regions(const cv::Mat& labels, const cv::Mat& image, const RegionRules& rules);

/// As the stream has it; signature is left 0.
sensor::Blob to_blob(const ImageRegion& region);

}  // namespace fencepost::host
