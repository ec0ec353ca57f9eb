// Keeps the largest blobs of a frame, in order.
#pragma once

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::serial {

/// Puts `blob` where it belongs, by pixels (by the box where the sensor does not tell); equals keep their order.
/// False if one had to go: the smallest, of a full frame and `blob`.
[[nodiscard]] bool insert_largest_first(sensor::BlobFrame& frame, const sensor::Blob& blob);

}  // namespace fencepost::serial
