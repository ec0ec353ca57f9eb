// Which ends of a blob are not its own: a nearer blob beside it may hide the rest. Inferred from the frame alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/observe/tuning.hpp"

namespace fencepost::recon {

/// A side counts as hidden when another blob reaches to within `beside_px` of it (kTouchPixels if of its own signature:
/// what of one colour has a gap between was not merged), is as high in the image as this one, and is not clearly
/// farther. Order: the lower bottom row is the nearer object; a bottom on the image border is nearer than any that is
/// not; equal rows do not tell, and what may be hidden is not used. The bottom counts as hidden when a nearer blob
/// overlaps it from below in most of its columns: the foot of a part that is seen is a foot. Bearings hide nothing.
Sides hidden_sides(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows,
                   int beside_px = kTouchPixels);

/// A blob that the border cuts ends near it, for that edge is no sharper than others. `image_columns`: of the image.
Sides near_border(const Box& box, std::int16_t image_columns);

}  // namespace fencepost::recon
