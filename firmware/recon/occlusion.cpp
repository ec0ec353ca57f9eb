#include "firmware/recon/occlusion.hpp"

#include <algorithm>

namespace fencepost::recon {
namespace {

int bottom_row(const Box& box, std::int16_t image_rows) {
  return box.y2 >= image_rows - 2 ? image_rows + kSameRowPixels + 1 : box.y2;
}

bool clearly_farther(const Box& other, const Box& box, std::int16_t image_rows) {
  return bottom_row(other, image_rows) < bottom_row(box, image_rows) - kSameRowPixels;
}

bool clearly_nearer(const Box& other, const Box& box, std::int16_t image_rows) {
  return clearly_farther(box, other, image_rows);
}

bool same_rows(const Box& a, const Box& b) {
  const auto near = [](int p, int q) { return p - q <= kTouchPixels && q - p <= kTouchPixels; };
  return near(a.y1, b.y1) && near(a.y2, b.y2);
}

// Does `post` fill the columns between `left` and `right`, in front of both?
bool fills_gap(const Box& post, const Box& left, const Box& right) {
  return post.x1 <= left.x2 + kTouchPixels && post.x2 >= right.x1 - kTouchPixels && post.x1 > left.x1 &&
         post.x2 < right.x2 && post.y1 <= left.y1 + kTouchPixels && post.y2 >= left.y2 - kTouchPixels;
}

bool any_post_between(std::span<const WaitingBlob> blobs, const WaitingBlob& left, const WaitingBlob& right) {
  for (const WaitingBlob& post : blobs) {
    if (&post != &left && &post != &right && fills_gap(post.box, left.box, right.box)) return true;
  }
  return false;
}

}  // namespace

HiddenEnds hidden_ends(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows) {
  const Box& box = blobs[index].box;
  HiddenEnds hidden;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    if (i == index) continue;
    const Box& other = blobs[i].box;
    const bool beside = other.y1 <= box.y1 + kTouchPixels && other.y2 >= box.y1;
    if (beside && !clearly_farther(other, box, image_rows)) {
      if (other.x1 < box.x1 && other.x2 >= box.x1 - kTouchPixels) hidden.left = true;
      if (other.x2 > box.x2 && other.x1 <= box.x2 + kTouchPixels) hidden.right = true;
    }
    const bool below = other.x1 <= box.x2 && other.x2 >= box.x1 && other.y1 <= box.y2 + kTouchPixels;
    if (below && clearly_nearer(other, box, image_rows)) hidden.bottom = true;
  }
  return hidden;
}

CutPair find_cut_pair(std::span<const WaitingBlob> blobs, std::size_t from_left, std::size_t from_right) {
  for (std::size_t a = from_left; a < blobs.size(); ++a) {
    for (std::size_t b = a == from_left ? from_right : 0; b < blobs.size(); ++b) {
      if (a == b || blobs[a].signature != blobs[b].signature || blobs[a].box.x2 >= blobs[b].box.x1) continue;
      if (!same_rows(blobs[a].box, blobs[b].box) || !any_post_between(blobs, blobs[a], blobs[b])) continue;
      return {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b), true};
    }
  }
  return {};
}

void join(base::FixedVector<WaitingBlob, sensor::kMaxBlobs>& blobs, const CutPair& pair) {
  Box& joined = blobs[pair.left].box;
  const Box& other = blobs[pair.right].box;
  joined.x2 = other.x2;
  joined.y1 = std::min(joined.y1, other.y1);
  joined.y2 = std::max(joined.y2, other.y2);
  blobs.erase_at(pair.right);
}

}  // namespace fencepost::recon
