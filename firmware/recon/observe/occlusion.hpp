// Which ends of a blob are not its own: a nearer blob beside it may hide the rest. Inferred from the frame alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/camera_model.hpp"
#include "firmware/recon/observe/frame_queue.hpp"

namespace fencepost::recon {

/// Two blobs this close (px) touch: 2 px plus three sigmas of an edge.
inline constexpr int kTouchPixels = 5;

/// A side counts as hidden when another blob reaches to within `beside_px` of it (kTouchPixels if of its own signature:
/// what of one colour has a gap between was not merged), is as high in the image as this one, and is not clearly
/// farther. Order: the lower bottom row is the nearer object; a bottom on the image border is nearer than any that is
/// not; equal rows do not tell, and what may be hidden is not used. The bottom counts as hidden when a nearer blob
/// overlaps it from below in most of its columns: the foot of a part that is seen is a foot.
Sides hidden_sides(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows,
                   int beside_px = kTouchPixels);

/// A blob that the border cuts ends near it, for that edge is no sharper than others. `image_columns`: of the image.
Sides near_border(const Box& box, std::int16_t image_columns);

/// An end may be a neighbour's within this (px): 2 px plus three sigmas of the gap between two edges. To call one's own
/// end hidden costs little, since it still says how far the object reaches at least; to take another's for one's own
/// does.
inline constexpr int kBesidePixels = 8;
/// Within this many columns of the border an end may be the border's.
inline constexpr int kBorderColumns = 5;
/// Bottom rows that differ by no more than this (px) do not tell which object is nearer.
inline constexpr int kSameRowPixels = 1;

}  // namespace fencepost::recon
