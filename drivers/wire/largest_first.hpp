// The order and the size of a frame's list of blobs.
#pragma once

#include <cstdint>

#include "hal/sensor/blob_frame.hpp"

namespace fencepost::wire {

using Blobs = base::FixedVector<sensor::Blob, sensor::kMaxBlobs>;

/// Puts the blob where it belongs by the area of its box, behind those of equal size. When full, the smallest goes.
/// out: whether a blob, this one or another, had to go
bool insert_largest_first(Blobs& blobs, const sensor::Blob& blob);

}  // namespace fencepost::wire
