// Connected pieces of one colour in a label image: what a blob camera finds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/simulate/render.hpp"

namespace fencepost::host {

/// Eight-connected pixels of one signature: of one object, or of several that touch in the image.
struct Piece {
  std::size_t object = 0;           ///< the one with the most pixels, of equal ones the first
  std::vector<std::size_t> others;  ///< the other objects in it, ascending
  std::size_t left = 0;             ///< the object at the left end of the box, in the uppermost row there
  std::size_t right = 0;            ///< at its right end
  PixelBox box;
  std::int64_t pixels = 0;
  std::int64_t sum_u = 0;
  std::int64_t sum_v = 0;
  double nearest = 0;  ///< least distance ahead of its pixels, m
};

/// `signatures`: of each object. In order of object, then of the piece's topmost-leftmost pixel.
std::vector<Piece> find_pieces(const LabelImage& image, std::span<const std::uint8_t> signatures);

}  // namespace fencepost::host
