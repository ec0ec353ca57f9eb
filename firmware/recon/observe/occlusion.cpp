#include "firmware/recon/observe/occlusion.hpp"

#include <algorithm>

namespace fencepost::recon {
namespace {

int bottom_row(const Box& box, std::int16_t image_rows) {
  return box.y2 >= image_rows - 2 ? image_rows + kBorderPixels + 1 : box.y2;
}

bool clearly_farther(const Box& other, const Box& box, std::int16_t image_rows) {
  return bottom_row(other, image_rows) < bottom_row(box, image_rows) - kBorderPixels;
}

bool clearly_nearer(const Box& other, const Box& box, std::int16_t image_rows) {
  return clearly_farther(box, other, image_rows);
}

}  // namespace

Sides hidden_sides(std::span<const WaitingBlob> blobs, std::size_t index, std::int16_t image_rows, int beside_px) {
  const Box& box = blobs[index].box;
  Sides hidden;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    const Box& other = blobs[i].box;
    if (other.x1 > box.x2 + beside_px || other.x2 < box.x1 - beside_px || i == index) continue;  // most of them
    if (blobs[i].bearing) continue;
    const int reach = blobs[i].signature == blobs[index].signature ? kTouchPixels : beside_px;
    const bool beside = other.y1 <= box.y1 + kTouchPixels && other.y2 >= box.y1;
    if (beside && !clearly_farther(other, box, image_rows)) {
      if (other.x1 < box.x1 && other.x2 >= box.x1 - reach) hidden.left = true;
      if (other.x2 > box.x2 && other.x1 <= box.x2 + reach) hidden.right = true;
    }
    const int covered = std::min(other.x2, box.x2) - std::max(other.x1, box.x1) + 1;
    const bool below = 2 * covered > box.x2 - box.x1 + 1 && other.y1 <= box.y2 + kTouchPixels;
    if (below && clearly_nearer(other, box, image_rows)) hidden.bottom = true;
  }
  return hidden;
}

Sides near_border(const Box& box, std::int16_t image_columns) {
  return {box.x1 < kTouchPixels, box.x2 >= image_columns - kTouchPixels, false, false};
}

}  // namespace fencepost::recon
