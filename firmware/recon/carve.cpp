#include "firmware/recon/carve.hpp"

namespace fencepost::recon {
namespace {

// Clears columns [begin, end) of one row.
void clear_columns(std::uint32_t* row, std::size_t begin, std::size_t end) {
  for (std::size_t word = begin / 32; begin < end; ++word) {
    const std::size_t stop = std::min(end, (word + 1) * 32);
    const std::uint32_t from = 0xFFFFFFFFU << (begin % 32);
    const std::uint32_t to = stop % 32 == 0 ? 0xFFFFFFFFU : (1U << (stop % 32)) - 1U;
    row[word] &= ~(from & to);
    begin = stop;
  }
}

// The first column i with i > x, in [0, columns].
std::size_t first_beyond(float x, std::size_t columns) {
  if (x < 0) return 0;
  if (x >= static_cast<float>(columns - 1)) return columns;
  return static_cast<std::size_t>(x) + 1;
}

// How many columns i have i + 1 < x, in [0, columns].
std::size_t whole_before(float x, std::size_t columns) {
  if (!(x > 1)) return 0;
  if (x > static_cast<float>(columns)) return columns;
  const auto whole = static_cast<std::size_t>(x);
  return static_cast<float>(whole) == x ? whole - 1 : whole;
}

// |normal.x| below this: the boundary is parallel to the rows to float precision, a row goes whole or not at all.
constexpr float kParallelToRows = 1e-6F;

}  // namespace

void carve_half_plane(std::span<std::uint32_t> words, std::size_t columns, std::size_t row_begin, std::size_t row_end,
                      const GridPlacement& placement, const HalfPlane& half_plane) {
  const float nx = half_plane.normal.x();
  const float ny = half_plane.normal.y();
  // Distances in cells, from the corner `low`: cell (i, j) is wholly outside if its innermost corner is, that is if
  // nx (i + [nx < 0]) + ny (j + [ny < 0]) > bound.
  const float bound = (half_plane.bound + kCarveGuard - half_plane.normal.dot(placement.low)) / placement.cell;
  const bool steep = nx > kParallelToRows || nx < -kParallelToRows;
  for (std::size_t j = row_begin; j < row_end; ++j) {
    std::uint32_t* row = words.data() + j * (columns / 32);
    const float rest = bound - ny * static_cast<float>(ny < 0 ? j + 1 : j);
    if (!steep) {
      if (rest + kParallelToRows * static_cast<float>(columns) < 0) clear_columns(row, 0, columns);
    } else if (nx > 0) {
      clear_columns(row, first_beyond(rest / nx, columns), columns);
    } else {
      clear_columns(row, 0, whole_before(rest / nx, columns));
    }
  }
}

}  // namespace fencepost::recon
