#include "host/models/carve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "hal/base/vectors.hpp"

namespace fencepost::recon {
namespace {

// |normal.x| below this: the boundary is parallel to the rows to float precision, a row goes whole or not at all.
constexpr float kParallelToRows = 1e-6F;

// A half plane over the grid, distances in cells, from the corner `low`. Cell (i, j) is wholly outside if its innermost
// corner is: nx (i + [nx < 0]) + ny (j + [ny < 0]) > bound.
struct Boundary {
  float nx;
  float ny;
  float bound;
  float size;  // columns
  int from;    // [ny < 0]

  // Where the boundary leaves row j, in columns, times nx.
  [[nodiscard]] float rest(int j) const { return bound - ny * static_cast<float>(j + from); }
};

// The loops below are written for vectors: no branches, and as little work a row as possible. Every step is exact or
// rounded once, so the number of rows done at a time does not change the result.

// Cuts the columns at the right, from the first i with i > x = rest / nx on: all columns where x is negative.
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

// Cuts the columns at the left: those i with i + 1 < x = rest / nx.
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

// The same boundary in whole numbers, for a desk: x in units of 2^-20 columns. It goes from row to row by one addition,
// where the loops above divide. Units and rounding leave open less than `open`. As long as no x is that near to a whole
// column, the cut is the same.
struct WholeBoundary {
  static constexpr int kBits = 20;
  static constexpr std::int32_t kColumn = 1 << kBits;
  // columns, of x at the first row and of all steps: their sum has room in 32 bits
  static constexpr double kMax = 1000;

  bool possible;
  std::int32_t start;  // at row 0
  std::int32_t step;
  std::int32_t open;

  WholeBoundary(const Boundary& b, int rows) {
    const double nx = static_cast<double>(b.nx);
    const double ny = static_cast<double>(b.ny);
    const double per_nx = 1.0 / nx;
    const double x = (static_cast<double>(b.bound) - ny * b.from) * per_nx;
    const double slope = -ny * per_nx;
    const double all_steps = std::fabs(slope) * rows;
    possible = std::fabs(x) < kMax && all_steps < kMax;
    start = possible ? nearest(x * kColumn) : 0;
    step = possible ? nearest(slope * kColumn) : 0;
    // Half a unit a row for the step and a whole one for the start. The plain form rounds products of ny, the rest and
    // x. Each error is at most 2^-24 of all steps, x and x, in columns. No x is larger than that of row 0 and all
    // steps.
    const double rounding = (2 * std::fabs(x) + 3 * all_steps) / 16;
    open = (possible ? static_cast<std::int32_t>(rounding) : 0) + 1 + rows / 2 + 2;
  }

  static std::int32_t nearest(double units) { return static_cast<std::int32_t>(units + (units < 0 ? -0.5 : 0.5)); }
};

// GCC's and clang's, on any processor; never an argument, for how vectors are passed depends on the processor.
using RowBlock = std::int16_t __attribute__((vector_size(2 * kCarveBlock)));
using HalfBlock = std::uint32_t __attribute__((vector_size(2 * kCarveBlock)));
using Whole = std::int32_t __attribute__((vector_size(2 * kCarveBlock)));

template <class Lanes>
[[gnu::always_inline]] inline bool any(const Lanes& yes) {
  std::array<std::uint64_t, sizeof yes / 8> parts;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::memcpy(parts.data(), &yes, sizeof yes);
  std::uint64_t all = 0;
  for (const std::uint64_t part : parts) all |= part;
  return all != 0;
}

// x of a block of rows, even and odd rows apart: so their upper halves, side by side, are in the order of the rows.
struct BlockOfRows {
  HalfBlock even;
  HalfBlock odd;
};
[[gnu::always_inline]] inline void begin_rows(const WholeBoundary& b, std::int32_t start, int row, BlockOfRows& x) {
  const auto step = static_cast<std::uint32_t>(b.step);
  HalfBlock twice;
  for (std::size_t lane = 0; lane < kCarveBlock / 2; ++lane) twice[lane] = static_cast<std::uint32_t>(2 * lane);
  x.even = static_cast<std::uint32_t>(start + row * b.step) + twice * step;
  x.odd = x.even + step;
}
[[gnu::always_inline]] inline void columns_of(const BlockOfRows& x, RowBlock& columns) {
  const HalfBlock upper = (x.even >> 16U) | (x.odd & 0xFFFF0000U);
  std::memcpy(&columns, &upper, sizeof columns);
  columns >>= WholeBoundary::kBits - 16;
}

// False: some x is too near to a whole column; then no more has been cut off than should be.
[[gnu::always_inline]] inline bool cut_right_in_whole(const WholeBoundary& b, std::int16_t* end, int row, int row_end) {
  BlockOfRows x;  // NOLINT(cppcoreguidelines-pro-type-member-init): two columns, begun at once
  begin_rows(b, b.start + b.open + WholeBoundary::kColumn, row, x);
  const auto stride = static_cast<std::uint32_t>(b.step) * std::uint32_t{kCarveBlock};
  Whole nearest = Whole{} + WholeBoundary::kColumn;
  for (; row < row_end; row += static_cast<int>(kCarveBlock)) {
    const Whole even = Whole(x.even & (WholeBoundary::kColumn - 1U));
    const Whole odd = Whole(x.odd & (WholeBoundary::kColumn - 1U));
    const Whole of_both = even < odd ? even : odd;
    nearest = of_both < nearest ? of_both : nearest;
    RowBlock first;
    columns_of(x, first);
    RowBlock before;
    std::memcpy(&before, &end[row], sizeof before);
    before = first < before ? first : before;
    std::memcpy(&end[row], &before, sizeof before);
    x.even += stride;
    x.odd += stride;
  }
  return !any(nearest <= 2 * b.open);
}

[[gnu::always_inline]] inline bool cut_left_in_whole(const WholeBoundary& b, std::int16_t* begin, int row,
                                                     int row_end) {
  BlockOfRows x;  // NOLINT(cppcoreguidelines-pro-type-member-init): two columns, begun at once
  begin_rows(b, b.start - b.open, row, x);
  const auto stride = static_cast<std::uint32_t>(b.step) * std::uint32_t{kCarveBlock};
  Whole farthest{};
  for (; row < row_end; row += static_cast<int>(kCarveBlock)) {
    const Whole even = Whole(x.even & (WholeBoundary::kColumn - 1U));
    const Whole odd = Whole(x.odd & (WholeBoundary::kColumn - 1U));
    const Whole of_both = even > odd ? even : odd;
    farthest = of_both > farthest ? of_both : farthest;
    RowBlock first;
    columns_of(x, first);
    RowBlock before;
    std::memcpy(&before, &begin[row], sizeof before);
    before = first > before ? first : before;
    std::memcpy(&begin[row], &before, sizeof before);
    x.even += stride;
    x.odd += stride;
  }
  return !any(farthest >= WholeBoundary::kColumn - 2 * b.open);
}

Boundary boundary_of(const HalfPlane& half_plane, const GridPlacement& placement, std::size_t columns) {
  return {half_plane.normal.x(), half_plane.normal.y(),
          (half_plane.bound + kCarveGuard - half_plane.normal.dot(placement.low)) / placement.cell,
          static_cast<float>(columns), half_plane.normal.y() < 0 ? 1 : 0};
}

[[gnu::always_inline]] inline void cut(const SolidRows& rows, const Boundary& boundary, int row, int row_end) {
  if (boundary.nx > kParallelToRows) return cut_right(boundary, rows.end.data(), row, row_end);
  if (boundary.nx < -kParallelToRows) return cut_left(boundary, rows.begin.data(), row, row_end);
  cut_rows(boundary, rows.end.data(), row, row_end);
}

[[gnu::always_inline]] inline bool cut_in_whole(const SolidRows& rows, const Boundary& boundary, int row, int row_end) {
  if (!(std::fabs(boundary.nx) > kParallelToRows)) return false;
  const WholeBoundary whole(boundary, row_end);
  if (!whole.possible) return false;
  if (boundary.nx > 0) return cut_right_in_whole(whole, rows.end.data(), row, row_end);
  return cut_left_in_whole(whole, rows.begin.data(), row, row_end);
}

[[gnu::always_inline]] inline bool block_empty(const SolidRows& rows, std::size_t row) {
  RowBlock begins;
  RowBlock ends;
  std::memcpy(&begins, &rows.begin[row], sizeof begins);
  std::memcpy(&ends, &rows.end[row], sizeof ends);
  return !any(begins < ends);
}

bool row_empty(const SolidRows& rows, std::size_t row) { return rows.begin[row] >= rows.end[row]; }

// In long steps over whole blocks while there are any; mostly there is nothing to do.
[[gnu::always_inline]] inline RowRange without_empty_rows(const SolidRows& rows, RowRange range) {
  if (range.begin < range.end && row_empty(rows, range.begin)) {
    while (range.begin + kCarveBlock <= range.end && block_empty(rows, range.begin)) range.begin += kCarveBlock;
    while (range.begin < range.end && row_empty(rows, range.begin)) ++range.begin;
  }
  if (range.begin < range.end && row_empty(rows, range.end - 1)) {
    while (range.begin + kCarveBlock <= range.end && block_empty(rows, range.end - kCarveBlock)) {
      range.end -= kCarveBlock;
    }
    while (range.begin < range.end && row_empty(rows, range.end - 1)) --range.end;
  }
  return range;
}

}  // namespace

FENCEPOST_FOR_EACH_PROCESSOR
void carve_half_plane(const SolidRows& rows, std::size_t columns, RowRange range, const GridPlacement& placement,
                      const HalfPlane& half_plane) {
  const Boundary boundary = boundary_of(half_plane, placement, columns);
  cut(rows, boundary, static_cast<int>(range.begin), static_cast<int>(range.end));
}

FENCEPOST_FOR_EACH_PROCESSOR
RowRange carve_blocks(const SolidRows& rows, std::size_t columns, RowRange range, const GridPlacement& placement,
                      const HalfPlane& half_plane) {
  const Boundary boundary = boundary_of(half_plane, placement, columns);
  const auto row = static_cast<int>(range.begin / kCarveBlock * kCarveBlock);
  const auto row_end = static_cast<int>((range.end + kCarveBlock - 1) / kCarveBlock * kCarveBlock);
  if (!cut_in_whole(rows, boundary, row, row_end)) cut(rows, boundary, row, row_end);
  return without_empty_rows(rows, range);
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
