// How well the camera sees one colour, from frame to frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "hal/sensor/camera.hpp"
#include "host/doctor/log/spacing.hpp"

namespace fencepost::host::doctor {

struct ColourQuality {
  std::uint8_t signature = 0;
  std::uint64_t frames = 0;  ///< with at least one blob of it
  double seen = 0;           ///< share of all frames
  double blobs = 0;          ///< in the frames that have any
  double flicker = 0;        ///< times that it was gone for up to kFlicker frames and came back, of 100 frames with it
  double jitter_px = 0;      ///< sigma of its width from frame to frame without motion; 0: too few frames
  double jitter = 0;         ///< the same as a share of its median width
};

class ColourMeter {
 public:
  static constexpr std::uint64_t kFlicker = 3;  ///< frames: longer absences are corners of the view
  static constexpr std::size_t kMinWidths = 10;

  /// `camera`: without one nothing is known of borders.
  void add(const sensor::BlobFrame& frame, const std::optional<sensor::CameraIntrinsics>& camera);
  /// Qualities of each signature that was seen.
  [[nodiscard]] std::vector<ColourQuality> qualities() const;

 private:
  struct Colour {
    std::uint64_t frames = 0;
    std::uint64_t blobs = 0;
    std::uint64_t flickers = 0;
    std::uint64_t last_seen = 0;  ///< number of the frame
    std::vector<double> widths;   ///< of the last frames in a row with exactly one whole blob, at most three
    Sample all_widths;            ///< of whole single blobs
    double second_steps = 0;      ///< sum of |w0 - 2 w1 + w2|, of three frames in a row
    std::uint64_t steps = 0;
  };
  void see(Colour& colour, std::uint64_t blobs, std::optional<double> width) const;

  std::uint64_t frames_ = 0;
  std::array<Colour, 256> colours_;
};

}  // namespace fencepost::host::doctor
