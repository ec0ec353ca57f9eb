// Converts boxes of one camera's image to another's: as if the same lens were in front of the other imager.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"

namespace fencepost::emulate {

/// Limits of a device's image reports.
struct ImageLimits {
  std::uint16_t width = 0;  ///< px
  std::uint16_t height = 0;
  std::size_t max_blobs = 16;
  std::size_t max_of_signature = 16;
  std::uint8_t first_signature = 0;
  std::uint8_t last_signature = 255;
  double max_rate = 60;  ///< images a second
};

/// Counts of blobs and boxes that a device could not report.
struct FitLosses {
  std::uint64_t signatures = 0;  ///< blobs of signatures that it does not have
  std::uint64_t blobs = 0;       ///< beyond its limit
  std::uint64_t outside = 0;     ///< boxes not inside the source's image
};

/// Edges are scaled by width and height and rounded to the nearest pixel edge; a box keeps one pixel at least. With
/// equal sizes every box stays as it is.
class ImageFit {
 public:
  /// `from`: without it, boxes are taken to be in the device's own pixels.
  ImageFit(const std::optional<sensor::CameraIntrinsics>& from, const ImageLimits& to);

  sensor::BlobFrame fit(const sensor::BlobFrame& frame);

  [[nodiscard]] bool scales() const { return from_width_ != to_.width || from_height_ != to_.height; }
  [[nodiscard]] const FitLosses& losses() const { return losses_; }

 private:
  [[nodiscard]] bool full(const sensor::BlobFrame& frame, std::uint8_t signature) const;
  [[nodiscard]] sensor::Blob scaled(const sensor::Blob& blob) const;

  ImageLimits to_;
  int from_width_;
  int from_height_;
  FitLosses losses_;
};

/// The calibration that belongs to the fitted boxes. `latency` and mount stay.
sensor::CameraIntrinsics fitted_calibration(const sensor::CameraIntrinsics& from, const ImageLimits& to,
                                            std::string_view model);

}  // namespace fencepost::emulate
