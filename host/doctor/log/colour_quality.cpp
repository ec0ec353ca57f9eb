#include "host/doctor/log/colour_quality.hpp"

#include <cmath>

namespace fencepost::host::doctor {
namespace {

/// An end on the image's border hides how wide the blob is; a bearing has no width.
bool whole(const sensor::Blob& blob, const std::optional<sensor::CameraIntrinsics>& camera) {
  if (blob.bearing) return false;
  return !camera || (blob.x1 > 1 && blob.x2 < camera->width - 2);
}

}  // namespace

void ColourMeter::add(const sensor::BlobFrame& frame, const std::optional<sensor::CameraIntrinsics>& camera) {
  ++frames_;
  std::array<std::uint8_t, 256> blobs{};
  std::array<std::optional<double>, 256> widths{};
  for (const sensor::Blob& blob : frame.blobs) {
    ++blobs[blob.signature];
    if (whole(blob, camera)) widths[blob.signature] = blob.x2 - blob.x1 + 1.0;
  }
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    if (blobs[i] == 0) {
      colours_[i].widths.clear();
    } else {
      see(colours_[i], blobs[i], blobs[i] == 1 ? widths[i] : std::nullopt);
    }
  }
}

void ColourMeter::see(Colour& colour, std::uint64_t blobs, std::optional<double> width) const {
  const std::uint64_t absent = colour.frames == 0 ? 0 : frames_ - colour.last_seen - 1;
  if (absent > 0 && absent <= kFlicker) ++colour.flickers;
  colour.last_seen = frames_;
  ++colour.frames;
  colour.blobs += blobs;
  if (!width) return colour.widths.clear();
  colour.all_widths.add(*width);
  colour.widths.push_back(*width);
  if (colour.widths.size() < 3) return;
  // An approach changes the width steadily; what is left of the second difference is the camera's.
  colour.second_steps += std::abs(colour.widths[0] - 2 * colour.widths[1] + colour.widths[2]);
  ++colour.steps;
  colour.widths.erase(colour.widths.begin());
}

std::vector<ColourQuality> ColourMeter::qualities() const {
  std::vector<ColourQuality> list;
  for (std::size_t i = 0; i < colours_.size(); ++i) {
    const Colour& colour = colours_[i];
    if (colour.frames == 0) continue;
    ColourQuality quality;
    quality.signature = static_cast<std::uint8_t>(i);
    quality.frames = colour.frames;
    const auto frames = static_cast<double>(colour.frames);
    quality.seen = frames / static_cast<double>(frames_);
    quality.blobs = static_cast<double>(colour.blobs) / frames;
    quality.flicker = 100 * static_cast<double>(colour.flickers) / frames;
    if (colour.steps >= kMinWidths) {
      // Mean magnitude, not a median: whole pixels are too coarse for one. sqrt(pi/2) sigma of it, sqrt(6) of the
      // steps.
      quality.jitter_px = 1.2533 * colour.second_steps / static_cast<double>(colour.steps) / std::sqrt(6.0);
      quality.jitter = quality.jitter_px / median_of(colour.all_widths.kept());
    }
    list.push_back(quality);
  }
  return list;
}

}  // namespace fencepost::host::doctor
