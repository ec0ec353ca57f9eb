// Connected pieces of each object in a label image: what a blob camera finds.
#pragma once

#include <vector>

#include "host/simulate/render.hpp"

namespace fencepost::host {

/// Eight-connected pixels of one object.
struct Piece {
  std::size_t object = 0;
  PixelBox box;
  std::int64_t pixels = 0;
  std::int64_t sum_u = 0;
  std::int64_t sum_v = 0;
  double nearest = 0;  ///< least distance ahead of its pixels, m
};

/// In order of object, then of the piece's topmost-leftmost pixel.
std::vector<Piece> find_pieces(const LabelImage& image);

}  // namespace fencepost::host
