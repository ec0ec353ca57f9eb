// Which ends of a blob are not its own: a nearer blob beside it may hide the rest. Inferred from the frame alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/recon/observe/frame_queue.hpp"
#include "firmware/recon/track/correspondence.hpp"

namespace fencepost::recon {

struct HiddenEnds {
  bool left = false;
  bool right = false;
  bool bottom = false;
};

/// Two blobs this close (px) touch: 2 px plus three sigmas of an edge.
inline constexpr int kTouchPixels = 5;

/// A side counts as hidden when another blob reaches to within `beside_px` of it (kTouchPixels if of its own signature:
/// what of one colour has a gap between was not merged), is as high in the image as this one, and is not clearly
/// farther. Order: the lower bottom row is the nearer object; a bottom on the image border is nearer than any that is
/// not; equal rows do not tell, and what may be hidden is not used. The bottom counts as hidden when a nearer blob
/// overlaps it from below in most of its columns: the foot of a part that is seen is a foot.
HiddenEnds hidden_ends(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows,
                       int beside_px = kTouchPixels);

/// A blob that the border cuts ends near it, for that edge is no sharper than others. `image_columns`: of the image.
HiddenEnds ends_near_border(const Box& box, std::int16_t image_columns);

/// Marks what is hidden as censored.
inline void censor(Interval& interval, const HiddenEnds& hidden) {
  interval.left_censored = interval.left_censored || hidden.left;
  interval.right_censored = interval.right_censored || hidden.right;
  interval.bottom_censored = interval.bottom_censored || hidden.bottom;
}

/// An end may be a neighbour's within this (px): 2 px plus three sigmas of the gap between two edges. To call one's own
/// end hidden costs little, since it still says how far the object reaches at least; to take another's for one's own
/// does.
inline constexpr int kBesidePixels = 8;
/// Within this many columns of the border an end may be the border's.
inline constexpr int kBorderColumns = 5;
/// Bottom rows that differ by no more than this (px) do not tell which object is nearer.
inline constexpr int kSameRowPixels = 1;

}  // namespace fencepost::recon
