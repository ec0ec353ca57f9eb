// Which ends of a blob are not its own: a nearer blob beside it may hide the rest. Inferred from the frame alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/tuning.hpp"

namespace fencepost::recon {

/// A side counts as hidden by another blob that reaches to within `beside_px` of it, is as high in the image and not
/// clearly farther. For a blob of the same signature the limit is kTouchPixels: with a gap the two were not merged.
/// The object with the lower bottom row is nearer; a bottom on the image border is nearer than any other. With equal
/// rows the order is unknown, and the side counts as hidden. The bottom counts as hidden if a nearer blob overlaps it
/// from below in most of its columns. Otherwise the visible part shows the foot. Bearings hide nothing.
Sides hidden_sides(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows,
                   int beside_px = kTouchPixels);

/// A blob that the border cuts ends near it, for that edge is no sharper than others. `image_columns`: of the image.
Sides near_border(const Box& box, std::int16_t image_columns);

}  // namespace fencepost::recon
