// Whole images with poses become the record stream that a blob camera would have given (user's text:
// share/doc/segment.md).
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "host/segment/colour_classes.hpp"
#include "host/segment/image_file.hpp"
#include "host/segment/image_list.hpp"
#include "host/segment/regions.hpp"
#include "host/segment/straighten.hpp"

namespace fencepost::host {

/// Where empty, chosen by the image's size: share/doc/segment.md.
struct SegmentOptions {
  Straightening straightening;
  ClassRules classes;
  std::optional<double> spatial;  ///< px, radius of the mean shift
  double range = 16;              ///< grey levels, likewise
  std::optional<int> min_pixels;
  std::optional<int> max_gap;  ///< px
  std::optional<int> border;   ///< px
};

struct SegmentSummary {
  int width = 0;  ///< px, of the images as they were segmented
  int height = 0;
  std::size_t frames = 0;
  std::size_t blobs = 0;
  std::size_t empty = 0;                 ///< frames without a blob
  std::size_t small = 0;                 ///< regions below min_pixels
  std::size_t merged = 0;                ///< regions joined to another of their signature
  std::size_t dropped = 0;               ///< regions beyond the 16 that a frame holds
  std::vector<SignatureUse> signatures;  ///< images: in which it became a blob
  std::vector<sensor::Rgb> background;
  std::vector<sensor::Rgb> rare;
};

struct Segmented {
  std::string log;  ///< a whole record stream
  SegmentSummary summary;
};

using SegmentResult = base::Result<Segmented, SegmentProblem>;

struct SegmentHooks {
  /// Called before each image of each pass: steps done, steps in all.
  std::function<void(std::size_t done, std::size_t all)> progress;
  /// Called with the index of a view and its labelled image.
  std::function<void(std::size_t view, const cv::Mat& picture)> labelled;
};

/// First pass: the colours of at most 24 views, evenly chosen. Second pass: the regions of all. Same images and
/// options, same bytes. `camera` is that of the image files; the log has the straightened one. Odometry is given at
/// each exposure, and often enough in between that no reader sees a gap. errors: an image that cannot be read or has
/// another size than the calibration, no region in any image
SegmentResult segment(const std::vector<View>& views, const sensor::CameraIntrinsics& camera,
                      const SegmentOptions& options, const SegmentHooks& hooks = {});

}  // namespace fencepost::host
