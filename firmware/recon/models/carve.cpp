#include "firmware/recon/models/carve.hpp"

#include <algorithm>

#include "hal/base/vectors.hpp"

namespace fencepost::recon {
namespace {

// |normal.x| below this: the boundary is parallel to the rows to float precision, a row goes whole or not at all.
constexpr float kParallelToRows = 1e-6F;

// A half plane over the grid, distances in cells, from the corner `low`: cell (i, j) is wholly outside if its innermost
// corner is, that is if nx (i + [nx < 0]) + ny (j + [ny < 0]) > bound.
struct Boundary {
  float nx;
  float ny;
  float bound;
  float size;  // columns
  int from;    // [ny < 0]

  // Where the boundary leaves row j, in columns, times nx.
  [[nodiscard]] float rest(int j) const { return bound - ny * static_cast<float>(j + from); }
};

// The loops below are written for vectors: no branches, as little as possible done a row, and all of it exact or
// rounded once, so that it does not matter how many rows are done at a time.

// What is outside is at the right, from the first column i with i > x = rest / nx: all columns where x is negative.
void cut_right(const Boundary& b, std::int16_t* end, int row, int row_end) {
  for (; row < row_end; ++row) {
    const float x = b.rest(row) / b.nx;
    const float left_part = x < b.size ? x : b.size;
    const float within = left_part > 0 ? left_part : 0;
    const auto first = static_cast<std::int16_t>(static_cast<int>(within) + (x < 0 ? 0 : 1));
    const std::int16_t before = end[row];
    end[row] = first < before ? first : before;
  }
}

// What is outside is at the left: the columns i with i + 1 < x = rest / nx.
void cut_left(const Boundary& b, std::int16_t* begin, int row, int row_end) {
  const float most = b.size + 0.5F;  // beyond the last column, and not whole
  for (; row < row_end; ++row) {
    const float x = b.rest(row) / b.nx;
    const float right_part = x > 0 ? x : 0;
    const float within = right_part < most ? right_part : most;
    const int whole = static_cast<int>(within);
    const auto first = static_cast<std::int16_t>(whole - (static_cast<float>(whole) < within ? 0 : 1));
    const std::int16_t before = begin[row];
    begin[row] = first > before ? first : before;
  }
}

void cut_rows(const Boundary& b, std::int16_t* end, int row, int row_end) {
  for (; row < row_end; ++row) {
    if (b.rest(row) + kParallelToRows * b.size < 0) end[row] = 0;
  }
}

}  // namespace

FENCEPOST_FOR_EACH_PROCESSOR
void carve_half_plane(SolidRows rows, std::size_t columns, std::size_t row_begin, std::size_t row_end,
                      const GridPlacement& placement, const HalfPlane& half_plane) {
  const float nx = half_plane.normal.x();
  const float ny = half_plane.normal.y();
  const Boundary boundary{nx, ny,
                          (half_plane.bound + kCarveGuard - half_plane.normal.dot(placement.low)) / placement.cell,
                          static_cast<float>(columns), ny < 0 ? 1 : 0};
  const auto first = static_cast<int>(row_begin);
  const auto last = static_cast<int>(row_end);
  if (nx > kParallelToRows) return cut_right(boundary, rows.end.data(), first, last);
  if (nx < -kParallelToRows) return cut_left(boundary, rows.begin.data(), first, last);
  cut_rows(boundary, rows.end.data(), first, last);
}

std::uint32_t solid_bits(std::int16_t begin, std::int16_t end, std::size_t word) {
  const int before = static_cast<int>(word) * 32;
  const auto below = [&](int column) {
    const int bits = std::clamp(column - before, 0, 32);
    return bits == 32 ? 0xFFFFFFFFU : (1U << static_cast<unsigned>(bits)) - 1U;
  };
  return below(end) & ~below(begin);
}

}  // namespace fencepost::recon
