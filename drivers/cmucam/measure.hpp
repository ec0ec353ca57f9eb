// A tracking packet as a blob in our convention.
#pragma once

#include <cstdint>

#include "drivers/cmucam/decoder.hpp"
#include "drivers/cmucam/dialect.hpp"
#include "hal/base/result.hpp"
#include "hal/sensor/blob_frame.hpp"

namespace fencepost::cmucam {

/// The box of a packet M, T, N or C: 1-based coordinates brought to 0-based; both have inclusive ends already. The
/// centroid of a C packet is its box's middle.
/// errors: kNotReady: nothing was found, or less than the dialect's confidence. kBadInput: the numbers cannot be a box
/// of this camera. Then the box lies outside the image, its corners are swapped, its centroid lies outside the box, or
/// it is an S packet.
base::Result<sensor::Blob> to_blob(const Packet& packet, const Dialect& dialect, std::uint8_t signature);

}  // namespace fencepost::cmucam
