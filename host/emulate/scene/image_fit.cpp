#include "host/emulate/scene/image_fit.hpp"

#include <algorithm>
#include <cmath>

namespace fencepost::emulate {
namespace {

struct Ends {
  int first = 0;
  int last = 0;
};

// Edge coordinates: pixel k covers k to k+1.
Ends scaled_ends(int first, int last, double scale, int size) {
  const int low = std::clamp(static_cast<int>(std::lround(first * scale)), 0, size - 1);
  const int high = static_cast<int>(std::lround((last + 1) * scale)) - 1;
  return {low, std::clamp(high, low, size - 1)};
}

base::Pixels1 scaled_centre(base::Pixels1 centre, double scale, const Ends& ends) {
  const base::Pixels1 moved = base::Pixels1::nearest((centre.to_double() + 0.5) * scale - 0.5);
  return std::clamp(moved, base::Pixels1{10 * ends.first}, base::Pixels1{10 * ends.last});
}

base::Pixels2 times(base::Pixels2 pixels, double scale) { return base::Pixels2::nearest(pixels.to_double() * scale); }
base::Pixels2 moved(base::Pixels2 at, double scale) {
  return base::Pixels2::nearest((at.to_double() + 0.5) * scale - 0.5);
}

}  // namespace

ImageFit::ImageFit(const std::optional<sensor::CameraIntrinsics>& from, const ImageLimits& to)
    : to_(to), from_width_(from ? from->width : to.width), from_height_(from ? from->height : to.height) {}

sensor::Blob ImageFit::scaled(const sensor::Blob& blob) const {
  const double across = static_cast<double>(to_.width) / from_width_;
  const double down = static_cast<double>(to_.height) / from_height_;
  const Ends x = scaled_ends(blob.x1, blob.x2, across, to_.width);
  const Ends y = scaled_ends(blob.y1, blob.y2, down, to_.height);
  sensor::Blob fitted = blob;
  fitted.x1 = static_cast<std::int16_t>(x.first);
  fitted.x2 = static_cast<std::int16_t>(x.last);
  fitted.y1 = static_cast<std::int16_t>(y.first);
  fitted.y2 = static_cast<std::int16_t>(y.last);
  fitted.cx = scaled_centre(blob.cx, across, x);
  fitted.cy = scaled_centre(blob.cy, down, y);
  const auto box = static_cast<std::uint32_t>((x.last - x.first + 1) * (y.last - y.first + 1));
  const auto area = static_cast<std::uint32_t>(std::lround(blob.pixels * across * down));
  fitted.pixels = blob.pixels == 0 ? box : std::clamp(area, 1U, box);
  return fitted;
}

bool ImageFit::full(const sensor::BlobFrame& frame, std::uint8_t signature) const {
  const auto same = std::count_if(frame.blobs.begin(), frame.blobs.end(),
                                  [&](const sensor::Blob& blob) { return blob.signature == signature; });
  return frame.blobs.size() >= to_.max_blobs || static_cast<std::size_t>(same) >= to_.max_of_signature;
}

sensor::BlobFrame ImageFit::fit(const sensor::BlobFrame& frame) {
  sensor::BlobFrame out{frame.t, frame.frame, {}};
  for (const sensor::Blob& blob : frame.blobs) {
    if (blob.signature < to_.first_signature || blob.signature > to_.last_signature) {
      ++losses_.signatures;
    } else if (blob.x1 < 0 || blob.y1 < 0 || blob.x2 >= from_width_ || blob.y2 >= from_height_) {
      ++losses_.outside;
    } else if (full(out, blob.signature) || !out.blobs.push_back(scaled(blob))) {
      ++losses_.blobs;
    }
  }
  return out;
}

sensor::CameraIntrinsics fitted_calibration(const sensor::CameraIntrinsics& from, const ImageLimits& to,
                                            std::string_view model) {
  const double across = static_cast<double>(to.width) / from.width;
  const double down = static_cast<double>(to.height) / from.height;
  sensor::CameraIntrinsics fitted = from;
  fitted.model = model;
  fitted.width = to.width;
  fitted.height = to.height;
  fitted.fx = times(from.fx, across);
  fitted.fy = times(from.fy, down);
  fitted.cx = moved(from.cx, across);
  fitted.cy = moved(from.cy, down);
  return fitted;
}

}  // namespace fencepost::emulate
