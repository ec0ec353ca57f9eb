// From the pieces of a perfect image to the blobs of a real camera: the noise of share/doc/scene.md.
#pragma once

#include <cstdint>
#include <vector>

#include "hal/sensor/blob_frame.hpp"
#include "host/scene/scene.hpp"
#include "host/simulate/pieces.hpp"
#include "host/simulate/truth.hpp"

namespace fencepost::host {

/// One blob and its truth.
struct Detection {
  sensor::Blob blob;
  BlobTruth truth;
};

/// All blobs of frame number `frame`, largest first (then leftmost, topmost). Draws depend on scene.seed, the
/// frame, the object and the piece only. Blobs narrower or lower than one pixel vanish.
std::vector<Detection> detect(const Scene& scene, const LabelImage& image, std::uint64_t frame);

}  // namespace fencepost::host
